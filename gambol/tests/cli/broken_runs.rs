//! A run folder that is damaged: `resume` says which file and where, and leaves everything as it was.

use crate::{
    damage::{edit, edit_and_seal, flip, json, places, raise_version, truncate, write},
    folder::{assert_same_run, assert_untouched, contents, read},
    program::{WITHOUT_SELECTION, assert_says, fail, gambol, small_run, small_run_of, succeed, text},
};
use serde_json::Value;
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// What a resumed run goes on from; each is needed, so that damage to each must be found.
const NEEDED: [&str; 5] = ["config.json", "checkpoint", "log.jsonl", "gallery.jsonl", "timing.jsonl"];

fn resume(path: &Path) -> Command {
    let mut resume = gambol("resume");
    resume.arg(path).args(["--no-report", "--generations", "6"]);
    resume
}

/// The damaged run is refused with a message that says all this, and nothing in it changes.
#[track_caller]
fn assert_refused(run: &Path, says: &[&str]) {
    let before = contents(run);
    assert_says(&fail(&mut resume(run)), says);
    assert_untouched(run, &before);
}

/// A file of another run, whole as it is, is no file of this one.
#[test]
fn a_report_is_not_made_of_two_runs() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [run, other] = ["run", "other"].map(|name| folder.path().join(name));
    succeed(&mut small_run(&run, 4));
    succeed(small_run_of("tetrapod-1", "running", &other, 4).args(["--seed", "2"]));
    for (name, says) in [
        ("champion.json", "is not the champion of this run: it differs from config.json in the creature"),
        ("config.json", "is not the checkpoint of this run: it differs from config.json in the seed"),
    ] {
        let own = read(&run.join(name));
        fs::copy(other.join(name), run.join(name))?;
        assert_says(&fail(gambol("report").arg(&run)), &[says]);
        write(&run.join(name), &own);
    }
    assert!(!run.join("report.html").exists(), "no page was written");
    succeed(gambol("report").arg(&run));
    Ok(())
}

/// Of runs that differ in the seed alone, and of the same run when it was shorter.
#[test]
fn champion_and_gallery_of_a_run_like_it_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [run, other, earlier] = ["run", "other", "earlier"].map(|name| folder.path().join(name));
    succeed(small_run(&run, 12).args(WITHOUT_SELECTION));
    // Longer, so that its gallery has lines enough.
    succeed(small_run(&other, 60).args(WITHOUT_SELECTION).args(["--seed", "2"]));
    succeed(small_run(&earlier, 1).args(WITHOUT_SELECTION));
    let (champion, gallery) = (run.join("champion.json"), run.join("gallery.jsonl"));
    let whole = read(&champion);
    for (from, says) in
        [(&other, "it differs from config.json in the seed"), (&earlier, "champion.json is older than its run")]
    {
        fs::copy(from.join("champion.json"), &champion)?;
        assert_says(&fail(gambol("report").arg(&run)), &[says]);
        // It is not what the checkpoint has, and so it is written again.
        succeed(gambol("resume").arg(&run).args(["--no-report", "--quiet"]));
        assert!(read(&champion) == whole, "the champion is there again");
    }
    let own = read(&gallery);
    fs::copy(other.join("gallery.jsonl"), &gallery)?;
    let says = "it is of another run than the log";
    assert_says(&fail(gambol("report").arg(&run)), &[says]);
    assert_says(&fail(gambol("resume").arg(&run).args(["--no-report", "--generations", "20"])), &[says]);
    write(&gallery, &own);
    succeed(gambol("report").arg(&run));
    Ok(())
}

#[test]
fn a_truncated_file_is_refused_wherever_it_ends() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 4));
    for name in NEEDED {
        let file = run.join(name);
        let whole = read(&file);
        for place in places(&file, 8) {
            truncate(&file, place);
            assert_refused(&run, &[text(&file), "line "]);
            write(&file, &whole);
        }
    }
    Ok(())
}

#[test]
fn a_flipped_bit_is_refused_wherever_it_is() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 4));
    for name in NEEDED {
        let file = run.join(name);
        let whole = read(&file);
        for (bit, place) in places(&file, 24).enumerate() {
            flip(&file, place, bit);
            // The e of an exponent may become an E; files of lines notice even that.
            if name.ends_with("jsonl") || !same_value(&whole, &read(&file)) {
                assert_refused(&run, &[text(&file)]);
            }
            write(&file, &whole);
        }
    }
    // That all of this was refused for the damage, and for nothing else:
    succeed(&mut resume(&run));
    Ok(())
}

fn same_value(one: &[u8], other: &[u8]) -> bool {
    let value = |bytes| serde_json::from_slice::<Value>(bytes).ok();
    value(one) == value(other)
}

#[test]
fn a_lost_line_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    // Without a champion selection each new best has a line in the gallery at once.
    succeed(small_run(&run, 4).args(WITHOUT_SELECTION));
    for name in ["log.jsonl", "gallery.jsonl", "timing.jsonl"] {
        let file = run.join(name);
        let whole = fs::read_to_string(&file)?;
        let lines: Vec<&str> = whole.split_inclusive('\n').collect();
        fs::write(&file, [&lines[..1], &lines[2..]].concat().concat())?;
        assert_refused(&run, &[text(&file), "line 2: it was changed"]);
        fs::write(&file, lines[..lines.len() - 1].concat())?;
        assert_refused(&run, &[text(&file), &format!("line {}: it is missing", lines.len())]);
        fs::remove_file(&file)?;
        assert_refused(&run, &[text(&file), "line 1: it is missing"]);
        fs::write(&file, whole)?;
    }
    Ok(())
}

#[test]
fn a_folder_of_another_version_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 2));
    for name in ["config.json", "checkpoint"] {
        let file = run.join(name);
        let whole = read(&file);
        raise_version(&file);
        assert_refused(&run, &[text(&file), "has version 3, this Gambol reads version 2; use a newer Gambol"]);
        let mut earlier = json(&file);
        earlier["version"] = 0.into();
        write(&file, earlier.to_string().as_bytes());
        assert_refused(&run, &[text(&file), "has version 0", "use the Gambol that wrote it"]);
        write(&file, &whole);
    }
    Ok(())
}

#[test]
fn a_configuration_edited_by_hand_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 2));
    edit(&run.join("config.json"), |content| content["physics"]["gravity"] = 1.62.into());
    assert_refused(&run, &[text(&run.join("config.json")), "was changed after it was written"]);
    Ok(())
}

#[test]
fn a_file_in_the_place_of_another_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 2));
    fs::copy(run.join("champion.json"), run.join("checkpoint"))?;
    assert_refused(&run, &[text(&run.join("checkpoint")), "\"gambol champion\"", "\"gambol checkpoint\""]);
    Ok(())
}

#[test]
fn what_is_no_run_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (empty, file) = (folder.path().join("empty"), folder.path().join("file"));
    fs::create_dir(&empty)?;
    fs::write(&file, "text")?;
    for path in [&empty, &file, &folder.path().join("missing")] {
        for command in ["resume", "report"] {
            let message = fail(gambol(command).arg(path));
            assert_says(&message, &[text(path), "is not the folder of a run: it has no config.json"]);
        }
    }
    Ok(())
}

/// The champion is in the checkpoint as well, so that nothing is lost with its file.
#[test]
fn a_damaged_champion_file_is_made_anew() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (run, whole) = (folder.path().join("run"), folder.path().join("whole"));
    succeed(&mut small_run(&whole, 6));
    succeed(&mut small_run(&run, 4));
    truncate(&run.join("champion.json"), 100);
    succeed(&mut resume(&run));
    assert_same_run(&whole, &run);
    Ok(())
}

#[test]
fn a_report_of_a_damaged_run_names_the_file_and_keeps_the_old_report() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 4));
    succeed(gambol("report").arg(&run));
    for name in ["config.json", "log.jsonl", "gallery.jsonl", "champion.json"] {
        let file = run.join(name);
        let whole = read(&file);
        flip(&file, whole.len() / 2, 1);
        let before = contents(&run);
        assert_says(&fail(gambol("report").arg(&run)), &[text(&file)]);
        assert_untouched(&run, &before);
        write(&file, &whole);
    }
    for name in ["log.jsonl", "gallery.jsonl"] {
        let file = run.join(name);
        let whole = read(&file);
        write(&file, b"");
        assert_says(&fail(gambol("report").arg(&run)), &[text(&file), "line 1: it is missing"]);
        write(&file, &whole);
    }
    succeed(gambol("report").arg(&run));
    Ok(())
}

/// With the seed of this one, and with as many evaluations.
#[test]
fn the_log_of_another_run_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (run, other) = (folder.path().join("run"), folder.path().join("other"));
    succeed(&mut small_run(&run, 4));
    succeed(small_run(&other, 4).args(["--set", "strategy.cma-es.step_size=0.77"]));
    fs::copy(other.join("log.jsonl"), run.join("log.jsonl"))?;
    assert_refused(&run, &["log.jsonl is not the log of this run", "generation 4 ended otherwise"]);
    assert_says(&fail(gambol("report").arg(&run)), &["log.jsonl is not the log of this run"]);
    Ok(())
}

#[test]
fn the_checkpoint_of_another_run_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (run, other) = (folder.path().join("run"), folder.path().join("other"));
    succeed(&mut small_run(&run, 4));
    let foreign: [(&[&str], &str); 3] = [
        (&["--seed", "9"], "the seed"),
        (&["--set", "strategy.cma-es.step_size=0.77"], "the strategy's settings"),
        (&["--set", "physics.gravity=9.7"], "its settings"),
    ];
    for (flags, says) in foreign {
        succeed(small_run(&other, 4).args(flags));
        fs::copy(other.join("checkpoint"), run.join("checkpoint"))?;
        assert_refused(&run, &["checkpoint of this run", says]);
        assert_says(&fail(gambol("report").arg(&run)), &["is not the checkpoint of this run"]);
        fs::remove_dir_all(&other)?;
    }
    Ok(())
}

#[test]
fn a_folder_in_which_another_process_works_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 4));
    let other_process = fs::File::open(run.join(".lock"))?;
    other_process.lock()?;
    assert_refused(&run, &["another gambol is at work", text(&run)]);
    drop(other_process);
    succeed(&mut resume(&run));
    Ok(())
}

/// A checkpoint that was made to fit, as only a program could: what its champion is worth gives it away.
#[test]
fn a_checkpoint_whose_champion_does_not_repeat_its_fitness_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, how) in [("selected", &[][..]), ("plain", &WITHOUT_SELECTION)] {
        let run = folder.path().join(name);
        succeed(small_run(&run, 4).args(["--set", "record.checkpoint_every=2"]).args(how));
        let checkpoint = run.join("checkpoint");
        let whole = read(&checkpoint);
        edit_and_seal(&checkpoint, |content| {
            let fitness = &mut content["champion"]["fitness"];
            *fitness = (fitness.as_f64().expect("a fitness") + 1.0).into();
        });
        assert_refused(&run, &[text(&checkpoint), "its champion has fitness ", "played again it has "]);
        edit_and_seal(&checkpoint, |content| {
            content["champion"]["genome"]["weights"][0] = 4.5.into();
        });
        assert_refused(&run, &[text(&checkpoint), "its champion has fitness "]);
        write(&checkpoint, &whole);
        succeed(&mut resume(&run));
    }
    Ok(())
}

#[test]
fn a_comparison_does_not_go_on_from_a_run_of_another_strategy() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let compare = || {
        let mut compare = gambol("compare");
        compare.args(["--strategies", "ga,neat", "--creatures", "biped-1", "--movements", "running", "--seeds", "2"]);
        compare.args(["--set", "movement.steps=40", "--evaluations", "100", "--quiet", "--out"]).arg(&out);
        compare
    };
    succeed(&mut compare());
    let place = |strategy: &str, seed: u32| out.join(format!("runs/{strategy}/biped-1-running/seed-{seed}"));
    fs::remove_file(out.join("results/ga/biped-1-running/seed-1.json"))?;
    for (other, what) in [(place("neat", 1), "strategy"), (place("ga", 2), "seed")] {
        fs::remove_dir_all(place("ga", 1))?;
        copy_folder(&other, &place("ga", 1))?;
        let says = format!("seed-1 is the folder of another run: its config.json has another \"{what}\" than the run");
        assert_says(&fail(&mut compare()), &[&says]);
    }
    fs::remove_dir_all(place("ga", 1))?;
    succeed(&mut compare());
    Ok(())
}

/// What is kept of a run that has ended is of a run that is whole, and had what the plan says.
#[test]
fn a_comparison_takes_no_damaged_run_and_none_with_another_budget() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let compare = |out: &Path, evaluations: &str| {
        let mut compare = gambol("compare");
        compare.args(["--strategies", "ga,hill-climbing", "--creatures", "biped-1", "--movements", "running"]);
        compare.args(["--seeds", "1", "--set", "movement.steps=40", "--evaluations", evaluations, "--quiet"]);
        compare.arg("--out").arg(out);
        compare
    };
    succeed(&mut compare(&out, "200"));
    let scores = read(&out.join("scores.csv"));
    let result = |out: &Path| out.join("results/ga/biped-1-running/seed-1.json");
    let [run, other] = ["ga", "hill-climbing"].map(|name| out.join(format!("runs/{name}/biped-1-running/seed-1")));
    let log = fs::read_to_string(run.join("log.jsonl"))?;
    let shorter: String = log.split_inclusive('\n').take(1).collect();
    let champion = read(&other.join("champion.json"));
    for (name, content, says) in [
        ("log.jsonl", shorter.as_bytes(), "log.jsonl, line 2: it is missing"),
        ("timing.jsonl", &[], "timing.jsonl, line 1: it is missing"),
        ("champion.json", &champion, "is not the champion of this run: it differs from config.json in the strategy"),
    ] {
        let file = run.join(name);
        let whole = read(&file);
        write(&file, content);
        fs::remove_file(result(&out))?;
        // A champion that is not the checkpoint's is written again.
        match name {
            "champion.json" => drop(succeed(&mut compare(&out, "200"))),
            _ => assert_says(&fail(&mut compare(&out, "200")), &[says]),
        }
        write(&file, &whole);
        succeed(&mut compare(&out, "200"));
        assert!(read(&out.join("scores.csv")) == scores, "{name}");
    }
    fs::remove_file(result(&out))?;
    let whole = folder.path().join("whole");
    copy_folder(&run, &whole)?;
    succeed(gambol("resume").arg(&run).args(["--evaluations", "800", "--no-report", "--quiet"]));
    assert_says(&fail(&mut compare(&out, "200")), &["its config.json has another \"stop\" than the run"]);
    fs::remove_dir_all(&run)?;
    fs::rename(&whole, &run)?;
    succeed(&mut compare(&out, "200"));
    let longer = folder.path().join("longer");
    succeed(&mut compare(&longer, "400"));
    fs::copy(result(&longer), result(&out))?;
    assert_says(&fail(&mut compare(&out, "200")), &["is the result of a run with other settings or another budget"]);
    Ok(())
}

#[test]
fn a_run_with_stages_does_not_go_on_from_a_stage_of_another_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let config = crate::shaping::write(folder.path(), &crate::shaping::three_stages());
    let [run, other] = ["run", "other"].map(|name| folder.path().join(name));
    succeed(crate::shaping::train(&config, &run).args(["--quiet", "--threads", "1"]));
    succeed(crate::shaping::train(&config, &other).args(["--quiet", "--threads", "1", "--seed", "9"]));
    for stage in ["01-run", "03-jump"] {
        let own = run.join("stages").join(stage);
        let aside = folder.path().join("aside");
        fs::rename(&own, &aside)?;
        copy_folder(&other.join("stages").join(stage), &own)?;
        let message = fail(gambol("resume").arg(&run).args(["--generations", "60", "--no-report"]));
        assert_says(
            &message,
            &[stage, "is the folder of another run: its config.json has another \"seed\" than the run"],
        );
        fs::remove_dir_all(&own)?;
        fs::rename(&aside, &own)?;
    }
    succeed(gambol("resume").arg(&run).args(["--generations", "60", "--no-report", "--quiet"]));
    Ok(())
}

#[test]
fn a_stage_that_was_passed_is_checked() -> Outcome {
    let folder = tempfile::tempdir()?;
    let config = crate::shaping::write(folder.path(), &crate::shaping::three_stages());
    let run = folder.path().join("run");
    succeed(crate::shaping::train(&config, &run).args(["--quiet", "--threads", "1"]));
    let log = run.join("stages/01-run/log.jsonl");
    let shorter: String = fs::read_to_string(&log)?.split_inclusive('\n').take(1).collect();
    write(&log, shorter.as_bytes());
    let says = "01-run/log.jsonl, line 2: it is missing";
    assert_says(&fail(gambol("report").arg(&run)), &[says]);
    assert_says(&fail(gambol("resume").arg(&run).args(["--generations", "60", "--no-report"])), &[says]);
    Ok(())
}

/// The files of a folder that has no others.
fn copy_folder(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        if entry.path().is_file() {
            fs::copy(entry.path(), to.join(entry.file_name()))?;
        }
    }
    Ok(())
}
