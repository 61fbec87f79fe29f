//! The report as JSON, for machines. docs/stability.md is the contract; a change that could break a reader of it
//! raises [`VERSION`].

use super::Report;
use crate::{Checked, Limit, Sweep, Verdict};
use serde::Serialize;

const VERSION: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    verdict: Verdict,
    summary: String,
    suites: Vec<SuiteEntry<'a>>,
    command: &'a str,
    machine: &'a sr_experiment::Machine,
}

#[derive(Serialize)]
struct SuiteEntry<'a> {
    name: &'a str,
    about: &'a str,
    verdict: Verdict,
    seconds: f64,
    sweeps: Vec<SweepEntry<'a>>,
}

#[derive(Serialize)]
struct SweepEntry<'a> {
    verdict: Verdict,
    fails_at: Limit,
    #[serde(flatten)]
    sweep: &'a Sweep,
}

fn suite(checked: &Checked) -> SuiteEntry<'_> {
    let sweep = |sweep| SweepEntry {
        verdict: Sweep::verdict(sweep),
        fails_at: sweep.limit(),
        sweep,
    };
    SuiteEntry {
        name: &checked.suite,
        about: &checked.about,
        verdict: checked.verdict(),
        seconds: checked.seconds,
        sweeps: checked.sweeps.iter().map(sweep).collect(),
    }
}

impl Report<'_> {
    /// As JSON. What is infinite is `null` there.
    ///
    /// # Errors
    /// Numbers that JSON cannot hold.
    pub fn json(&self) -> Result<String, String> {
        let document = Document {
            version: VERSION,
            verdict: self.verdict(),
            summary: self.summary(),
            suites: self.checked.iter().map(suite).collect(),
            command: self.command,
            machine: self.machine,
        };
        serde_json::to_string_pretty(&document).map_err(|e| format!("cannot write JSON: {e}"))
    }
}
