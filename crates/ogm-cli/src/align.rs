//! `ogm align`: the transform between two maps.

use crate::args::AlignArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::progress::Bar;
use crate::search::{check, search};
use crate::tags::logs_of;
use crate::{terminal, text};

pub(crate) fn run(args: &AlignArgs) -> anyhow::Result<Ending> {
    let logs = logs_of(&[&args.target, &args.source], &args.search.tags)?;
    check(&args.search, &logs)?;
    let quiet = args.search.quiet;
    let target = Input::read(&args.target, quiet)?;
    let source = Input::read(&args.source, quiet)?;
    let answer = {
        let bar = Bar::start("aligning", quiet);
        search([&target, &source], &logs, &args.search, &bar)?
    };
    let text = if args.search.json {
        serde_json::to_string_pretty(&answer)? + "\n"
    } else {
        text::pair(&answer)
    };
    terminal::result(&text)?;
    Ok(answer.ending())
}
