//! `ogm align`: the transform between two maps.

use crate::args::AlignArgs;
use crate::ending::Ending;
use crate::given::Given;
use crate::input::Input;
use crate::memory::Work;
use crate::progress::Bar;
use crate::search::{check, search};
use crate::tags::logs_of;
use crate::{terminal, text};

pub(crate) fn run(args: &AlignArgs) -> anyhow::Result<Ending> {
    let logs = logs_of(&[&args.target, &args.source], &args.search.tags)?;
    check(&args.search, &logs)?;
    let given = Given::new(&[&args.target, &args.source], 0, &[], &args.search)?;
    let quiet = args.search.quiet;
    args.reading.check_memory(&[&args.target, &args.source], Work::Aligning)?;
    let inputs = Input::read_all(&[&args.target, &args.source], &args.reading, quiet)?;
    let answer = {
        let bar = Bar::start("aligning", quiet);
        search([&inputs[0], &inputs[1]], &logs, &args.search, given.prior(), &bar)?
    };
    let text = if args.search.json {
        serde_json::to_string_pretty(&answer)? + "\n"
    } else {
        text::pair(&answer)
    };
    terminal::result(&text)?;
    Ok(answer.ending())
}
