//! A session of live merging that goes on from what was saved.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_merge::{MergeSession, SavedSession, SessionParams};

fuzz_target!(|bytes: &[u8]| {
    let Ok(saved) = serde_json::from_slice::<SavedSession>(bytes) else { return };
    let resume = |saved| MergeSession::resume(saved, SessionParams::default(), &());
    if let Ok(session) = resume(saved) {
        let saved = session.save();
        let text = serde_json::to_vec(&saved).expect("what was resumed can be saved");
        let again = serde_json::from_slice(&text).expect("what was saved can be read");
        assert_eq!(resume(again).expect("what was saved can be resumed").save(), saved);
    }
});
