//! `--both`: the paper's two experiments, with the peduncle and without it.

use std::io::Write;

use super::Evaluate;

/// Evaluates the folder twice, into two folders.
pub(super) fn run(args: &Evaluate) -> anyhow::Result<()> {
    for (name, without_peduncle) in [("with-peduncle", false), ("without-peduncle", true)] {
        let mut one = args.clone();
        one.both = false;
        one.analysis.without_peduncle = without_peduncle;
        one.out = args.out.join(name);
        writeln!(std::io::stdout(), "{name}:")?;
        super::run(&one)?;
        writeln!(std::io::stdout())?;
    }
    Ok(())
}
