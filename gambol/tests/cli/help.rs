use crate::program::{assert_says, gambol, run, succeed};

const COMMANDS: [&str; 23] = [
    "train",
    "resume",
    "report",
    "verify",
    "replay",
    "export",
    "film",
    "gait",
    "robust",
    "check",
    "compare",
    "tune",
    "reproduce",
    "merge",
    "bench",
    "studio",
    "creatures",
    "movements",
    "terrains",
    "variations",
    "strategies",
    "presets",
    "sensors",
];

#[test]
fn the_help_of_every_command_shows_an_example_of_it() {
    for command in COMMANDS {
        let help = succeed(gambol(command).arg("--help"));
        let (_, examples) = help.split_once("Example").unwrap_or_else(|| panic!("{command} has no examples"));
        assert_says(examples, &[&format!("\n  gambol {command}")]);
    }
}

#[test]
fn the_help_of_the_program_lists_its_commands_and_exit_codes() {
    let help = succeed(&mut gambol("--help"));
    for command in COMMANDS {
        assert_says(&help, &[&format!("\n  {command} ")]);
    }
    assert_says(&help, &["Examples:", "Exit codes:", "\n  0 ", "\n  1 ", "\n  2 ", "\n  3 ", "\n  130 "]);
}

#[test]
fn a_command_line_that_is_not_understood_ends_with_exit_code_2() {
    for (arguments, says) in [
        (&["frobnicate"][..], "unrecognized subcommand 'frobnicate'"),
        (&["resume"], "<FOLDER>"),
        (&["train", "biped-1", "running", "--generatons", "5"], "'--generations'"),
        (&["train", "biped-1", "running", "--seed", "-1"], "'-1'"),
        (&["train", "biped-1", "running", "--seed", "one"], "--seed"),
        (&["train", "biped-1", "running", "--generations", "1.5"], "--generations"),
        (&["train", "biped-1", "running", "--threads", "1000000"], "not in 0..=1024"),
        (&["train", "biped-1", "running", "--quiet", "--json"], "cannot be used with"),
    ] {
        let ended = run(gambol(arguments[0]).args(&arguments[1..]));
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
}

#[test]
fn a_reader_that_goes_away_is_no_panic() -> Result<(), std::io::Error> {
    let (reader, writer) = std::io::pipe()?;
    drop(reader);
    let ended = gambol("creatures").stdout(writer).output()?;
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    assert!(ended.stderr.is_empty());
    Ok(())
}
