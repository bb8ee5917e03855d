//! What is killed.

/// A command that writes, and what it must have written in the end.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    /// Files in the folder before the command.
    pub(crate) files: &'static [(&'static str, &'static str)],
    /// Commands before it.
    pub(crate) before: &'static [&'static [&'static str]],
    /// The command; its folder is `run`.
    pub(crate) command: &'static [&'static str],
    /// Whether it is gone on with by `resume`, once there is a run, or by itself.
    pub(crate) resumes: bool,
    /// What it writes for people to look at.
    pub(crate) page: &'static str,
    /// Too long for every day.
    pub(crate) takes_long: bool,
}

const TRAIN: Case =
    Case { name: "", files: &[], before: &[], command: &[], resumes: true, page: "report.html", takes_long: false };

/// A run of blinks.
macro_rules! train {
    ($($argument:expr),*) => {
        &[
            "train", "apod", "jumping", "--out", "run", "--quiet", "--seed", "5", "--set", "movement.steps=40",
            "--set", "record.populations_at=[1,3]", $($argument),*
        ]
    };
}

/// As [`train`], with a strategy and so many threads; it ends right at a checkpoint.
macro_rules! short {
    ($strategy:expr, $threads:expr $(, $more:expr)*) => {
        train!(
            "--strategy", $strategy, "--population", "10", "--threads", $threads, "--generations", "4",
            "--set", "record.checkpoint_every=2" $(, $more)*
        )
    };
}

/// As [`train`], with a strategy; it ends at a checkpoint between two re-evaluations, which become rarer after 8.
macro_rules! long {
    ($strategy:expr $(, $more:expr)*) => {
        train!(
            "--strategy", $strategy, "--population", "10", "--threads", "2", "--generations", "11",
            "--set", "record.checkpoint_every=1" $(, $more)*
        )
    };
}

const OBJECTIVES: &str = r#"movement.objectives=[{"term":"jumping"},{"term":"energy","weight":-0.5}]"#;

/// Two stages, of which the second goes on until the run ends.
const STAGES: &str = r#"{
    "creature": "apod", "movement": { "name": "jumping", "steps": 40 },
    "strategy": { "cma-es": { "population": 6 } }, "stop": { "generations": 4 },
    "record": { "checkpoint_every": 2, "populations_at": [1] },
    "stages": [
        { "name": "jump", "promotion": { "generations": 2 } },
        { "name": "feel", "add_sensors": ["joint-speeds"] }
    ]
}"#;

/// Two stages, of which both are passed.
const PASSED: &str = r#"{
    "creature": "apod", "movement": { "name": "jumping", "steps": 40 },
    "strategy": { "conventional": { "population": 6 } }, "stop": { "generations": 50 },
    "record": { "checkpoint_every": 2, "populations_at": [1] },
    "stages": [
        { "name": "jump", "promotion": { "generations": 2 } },
        { "name": "again", "promotion": { "generations": 3 } }
    ]
}"#;

const SOURCE: &[&str] = &[
    "train",
    "apod",
    "jumping",
    "--out",
    "source",
    "--quiet",
    "--no-report",
    "--population",
    "6",
    "--generations",
    "2",
    "--set",
    "movement.steps=40",
];

/// All of them.
pub(crate) const ALL: &[Case] = &[
    Case { name: "conventional", command: short!("conventional", "1"), ..TRAIN },
    Case { name: "neat", command: short!("neat", "1"), ..TRAIN },
    Case { name: "cma-es", command: short!("cma-es", "1"), ..TRAIN },
    Case { name: "open-es", command: short!("open-es", "1"), ..TRAIN },
    Case { name: "cosyne", command: short!("cosyne", "1"), ..TRAIN },
    Case { name: "nsga2", command: short!("nsga2", "1", "--set", OBJECTIVES), ..TRAIN },
    Case { name: "two threads", command: short!("conventional", "2"), ..TRAIN },
    Case {
        name: "stages",
        files: &[("stages.json", STAGES)],
        command: &["train", "--config", "stages.json", "--out", "run", "--quiet", "--threads", "1"],
        ..TRAIN
    },
    Case { name: "from a run", before: &[SOURCE], command: short!("cma-es", "1", "--from", "source"), ..TRAIN },
    Case {
        name: "a comparison",
        command: &[
            "compare",
            "--strategies",
            "ga,cma-es",
            "--creatures",
            "apod",
            "--movements",
            "jumping",
            "--seeds",
            "1",
            "--set",
            "movement.steps=40",
            "--set",
            "record.checkpoint_every=1",
            "--evaluations",
            "100",
            "--out",
            "run",
            "--quiet",
            "--at-once",
            "1",
            "--threads",
            "1",
        ],
        resumes: false,
        page: "comparison.html",
        ..TRAIN
    },
    Case { name: "conventional, long", command: long!("conventional"), takes_long: true, ..TRAIN },
    Case { name: "neat, long", command: long!("neat"), takes_long: true, ..TRAIN },
    Case { name: "cma-es, long", command: long!("cma-es"), takes_long: true, ..TRAIN },
    Case { name: "open-es, long", command: long!("open-es"), takes_long: true, ..TRAIN },
    Case { name: "cosyne, long", command: long!("cosyne"), takes_long: true, ..TRAIN },
    Case { name: "nsga2, long", command: long!("nsga2", "--set", OBJECTIVES), takes_long: true, ..TRAIN },
    Case {
        name: "stages that are passed",
        files: &[("stages.json", PASSED)],
        command: &["train", "--config", "stages.json", "--out", "run", "--quiet", "--threads", "2"],
        takes_long: true,
        ..TRAIN
    },
];
