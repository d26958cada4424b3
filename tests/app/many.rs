//! The open clouds as a set, without a window: evaluated in the background, cached, sorted, filtered, saved.

use crate::helpers::command_line;
use crate::helpers::driving;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::helpers::driving::{act, app, set, settle};
use crate::helpers::peppers::{make_older, write_peppers};
use axiscope::app::many::{
    Column, Filter, ManyCommand, Sort, SweepRanges, TableRow, evaluate_command_line, ordered,
};
use axiscope::app::{App, Command, Session};
use axiscope::evaluate::{CloudTags, Outcome, Row, TruthChoice, examine};
use axiscope::fruit::Fruit;
use proptest::prelude::*;
use tempfile::TempDir;

/// A program that keeps its rows in `cache`, with the folder open and evaluated.
fn opened(folder: &Path, cache: &Path) -> App {
    let mut app = app();
    app.keep_rows_in(cache.to_owned());
    act(&mut app, Command::Open(vec![folder.to_owned()]));
    app
}

fn rows(app: &App) -> Vec<Row> {
    let rows = app.state().many.rows.iter();
    rows.map(|row| {
        row.outcome
            .as_ref()
            .expect("evaluated")
            .against(TruthChoice::Auto)
    })
    .collect()
}

fn names_in_order(app: &App) -> Vec<String> {
    let folder = &app.state().many;
    folder
        .order
        .iter()
        .map(|&place| folder.rows[place].name.clone())
        .collect()
}

fn folder(command: ManyCommand) -> Command {
    Command::Many(command)
}

#[test]
fn a_small_folder_is_evaluated_as_it_is_opened_and_rows_equal_examine_s() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    let paths = write_peppers(&set, 4);
    let app = opened(&set, &dir.path().join("cache"));
    assert_eq!(app.state().entries.len(), 4);
    assert_eq!(app.state().many.missing, 0);
    assert!(app.state().many.progress.is_none());
    let request = app.state().settings.request.clone();
    for (row, path) in rows(&app).iter().zip(&paths) {
        let fruit = Fruit::read(path, &request).expect("a fruit");
        let examined = examine(fruit, &request, &()).expect("analyzed");
        let examined = examined.with_true_center(&()).expect("not cancelled");
        let name = path.file_name().expect("a name").to_string_lossy();
        assert_eq!(*row, Outcome::of(&name, &examined).against(TruthChoice::Auto));
        assert!(row.error_deg.is_some() && row.peduncle_error_deg.is_some());
    }
}

#[test]
fn rows_come_back_after_a_restart_without_reading_the_clouds() {
    let dir = TempDir::new().expect("a folder");
    let (set, cache) = (dir.path().join("set"), dir.path().join("cache"));
    let paths = write_peppers(&set, 4);
    let first = opened(&set, &cache);
    let before = rows(&first);
    // A cloud and its truth each; the others' files do not exist.
    assert_eq!(first.background_reads(), 8);
    drop(first);

    // Of the same size and time, but no cloud any more: only somebody who reads it would know.
    let length = std::fs::metadata(&paths[2]).expect("there").len();
    let time = std::fs::metadata(&paths[2])
        .expect("there")
        .modified()
        .expect("a time");
    std::fs::write(&paths[2], vec![b'x'; usize::try_from(length).expect("small")]).expect("written");
    let file = std::fs::File::options()
        .append(true)
        .open(&paths[2])
        .expect("there");
    file.set_modified(time).expect("its time can be set");

    let again = opened(&set, &cache);
    assert_eq!(again.background_reads(), 0);
    assert_eq!(rows(&again), before);

    // Changed and seen to be: worked out anew, and a row with its reason.
    make_older(&paths[2]);
    let third = opened(&set, &cache);
    assert_eq!(third.background_reads(), 1);
    let row = &rows(&third)[2];
    assert!(row.failure.is_some() && row.sha256.is_none(), "{row:?}");
    assert!(third.state().entries[2].problem.is_some());
    assert_eq!(rows(&third)[3], before[3]);
}

#[test]
fn a_broken_line_in_the_cache_is_worked_out_again() {
    let dir = TempDir::new().expect("a folder");
    let (set, cache) = (dir.path().join("set"), dir.path().join("cache"));
    write_peppers(&set, 3);
    let before = rows(&opened(&set, &cache));
    let file = std::fs::read_dir(&cache)
        .expect("a cache")
        .map(|entry| entry.expect("an entry").path())
        .find(|path| {
            path.file_name()
                .is_some_and(|n| n.to_string_lossy().starts_with("rows-"))
        })
        .expect("rows are kept");
    let text = std::fs::read_to_string(&file).expect("text");
    let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
    assert_eq!(lines.len(), 3);
    // One digit of an error is another, one line is half there, and one is whole behind it.
    let forged = lines[0].replacen("\"error_deg\":", "\"error_deg\":9", 1);
    assert_ne!(forged, lines[0]);
    let half = &lines[1][..lines[1].len() / 2];
    std::fs::write(&file, format!("{forged}\n{half}\n{}\n", lines[2])).expect("written");
    assert_eq!(rows(&opened(&set, &cache)), before);
    let lines = std::fs::read_to_string(&file).expect("text");
    assert_eq!(
        lines.lines().filter(|line| !line.is_empty()).count(),
        5,
        "two were added"
    );
}

#[test]
fn called_off_and_taken_up_again_is_as_unbroken() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    // So many that some are left however many cores there are.
    let small = write_peppers(&set, 6).remove(5);
    let bytes = std::fs::read(&small).expect("there");
    for copy in 0..34 {
        let text = format!("ply\ncomment {copy}\n").into_bytes();
        let other = [&text, &bytes[4..]].concat();
        std::fs::write(set.join(format!("copy_{copy:02}.ply")), other).expect("written");
    }
    let unbroken = rows(&opened(&set, &dir.path().join("one")));

    let mut app = app();
    app.keep_rows_in(dir.path().join("two"));
    app.apply(Command::Open(vec![set]));
    let began = Instant::now();
    // Until the first rows are there.
    while app.state().many.progress.is_none_or(|p| p.done < 2) && app.is_busy() {
        app.update(Duration::from_millis(50));
        assert!(began.elapsed() < Duration::from_mins(1));
    }
    app.apply(folder(ManyCommand::Cancel));
    settle(&mut app);
    let missing = app.state().many.missing;
    assert!((1..=38).contains(&missing), "{missing} are missing");
    assert!(app.state().many.was_cancelled);
    act(&mut app, folder(ManyCommand::Evaluate));
    assert_eq!(app.state().many.missing, 0);
    assert_eq!(rows(&app), unbroken);
}

#[test]
fn changed_parameters_make_rows_stale_and_old_ones_bring_them_back() {
    let dir = TempDir::new().expect("a folder");
    let folder_path = dir.path().join("set");
    write_peppers(&folder_path, 3);
    let mut app = opened(&folder_path, &dir.path().join("cache"));
    let before = rows(&app);
    let reads = app.background_reads();
    set(&mut app, |r| r.params.u = 9);
    let folder_state = &app.state().many;
    // The current cloud is analyzed anyway.
    assert_eq!(folder_state.missing, 2);
    assert!(!folder_state.rows[0].is_stale && folder_state.rows[1].is_stale);
    act(&mut app, folder(ManyCommand::Evaluate));
    assert_eq!(app.state().many.missing, 0);
    assert_ne!(rows(&app)[1].best, None);
    assert_ne!(rows(&app), before);
    act(&mut app, Command::Undo);
    assert_eq!(app.state().many.missing, 0, "they come from the cache");
    assert_eq!(rows(&app), before);
    assert_eq!(app.background_reads(), reads, "and no file is read for that");
}

#[test]
fn what_cannot_be_read_is_a_row_and_folders_of_all_kinds_open() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    write_peppers(&set, 2);
    std::fs::write(set.join("broken.ply"), "ply\nformat ascii 1.0\n").expect("written");
    std::fs::create_dir(set.join("nested.ply")).expect("a folder");
    write_peppers(&set.join("deeper"), 1);
    #[cfg(unix)]
    let set = {
        std::os::unix::fs::symlink(set.join("gone.ply"), set.join("dangling.ply")).expect("a link");
        let link = dir.path().join("link");
        std::os::unix::fs::symlink(&set, &link).expect("a link");
        link
    };
    let app = opened(&set, &dir.path().join("cache"));
    let names: Vec<_> = app.state().many.rows.iter().map(|r| r.name.as_str()).collect();
    if cfg!(unix) {
        assert_eq!(
            names,
            ["broken.ply", "dangling.ply", "pepper_000.ply", "pepper_001.ply"]
        );
    }
    for row in rows(&app) {
        assert_eq!(row.failure.is_none(), row.file.starts_with("pepper"), "{row:?}");
    }
    let dangling = rows(&app).into_iter().find(|r| r.file == "dangling.ply");
    assert!(dangling.is_none_or(|r| r.failure.as_deref() == Some("there is no such file")));

    let mut empty = driving::app();
    let nothing = dir.path().join("nothing");
    std::fs::create_dir(&nothing).expect("a folder");
    act(&mut empty, Command::Open(vec![nothing]));
    assert!(
        empty
            .state()
            .messages
            .iter()
            .any(|m| m.text.contains("no PLY files"))
    );
}

#[test]
fn previous_and_next_follow_the_table() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    write_peppers(&set, 5);
    let mut app = opened(&set, &dir.path().join("cache"));
    let sort = Sort {
        by: Column::TrueError,
        is_descending: true,
    };
    act(&mut app, folder(ManyCommand::Sort(sort)));
    let worst_first = names_in_order(&app);
    let errors: Vec<f64> = app
        .state()
        .many
        .order
        .iter()
        .map(|&p| {
            app.state().many.rows[p]
                .error_deg(TruthChoice::Truth)
                .expect("an error")
        })
        .collect();
    assert!(errors.is_sorted_by(|a, b| a >= b), "{errors:?}");
    let worst = app.state().many.order[0];
    act(&mut app, Command::Show(worst));
    for name in &worst_first[1..] {
        act(&mut app, Command::Go(1));
        assert_eq!(
            app.state().source().map(axiscope::app::Source::name).as_ref(),
            Some(name)
        );
    }
    assert_eq!(app.state().neighbor(1), None);
    // Of those that are filtered out, none is gone to.
    let filter = Filter {
        above_deg: Some(0.5 * (errors[1] + errors[2])),
        ..Filter::default()
    };
    act(&mut app, folder(ManyCommand::Filter(Box::new(filter))));
    assert_eq!(names_in_order(&app), worst_first[..2]);
    act(&mut app, Command::Go(-1));
    assert_eq!(
        app.state().source().map(axiscope::app::Source::name).as_ref(),
        Some(&worst_first[1])
    );
}

#[test]
fn files_that_have_changed_are_evaluated_when_asked_again() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    let paths = write_peppers(&set, 2);
    let mut app = opened(&set, &dir.path().join("cache"));
    let before = rows(&app);
    std::fs::remove_file(paths[1].with_extension("truth.json")).expect("removed");
    act(&mut app, folder(ManyCommand::Evaluate));
    let after = rows(&app);
    assert_eq!(after[0], before[0]);
    assert_eq!(
        (after[1].truth.as_deref(), before[1].truth.as_deref()),
        (Some("peduncle"), Some("simulation"))
    );
}

#[test]
fn a_large_folder_waits_to_be_asked() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    let first = write_peppers(&set, 1).remove(0);
    for copy in 1..=200 {
        std::fs::copy(&first, set.join(format!("copy_{copy:03}.ply"))).expect("copied");
    }
    let app = opened(&set, &dir.path().join("cache"));
    assert_eq!(app.state().entries.len(), 201);
    assert_eq!(app.state().many.missing, 200, "all but the current one");
    assert_eq!(app.background_reads(), 0);
}

#[test]
fn saved_results_are_those_of_the_command_line_that_is_copied() {
    let dir = TempDir::new().expect("a folder");
    let set_folder = dir.path().join("set");
    write_peppers(&set_folder, 3);
    std::fs::write(set_folder.join("broken.ply"), "ply\n").expect("written");
    let mut app = opened(&set_folder, &dir.path().join("cache"));
    let tagged = CloudTags {
        note: "odd".into(),
        ..CloudTags::default().with_tags("leaf")
    };
    act(&mut app, folder(ManyCommand::Tag { place: 2, tagged }));
    set(&mut app, |r| r.params.u = 7);
    act(&mut app, Command::Compare(TruthChoice::Peduncle));
    let into = dir.path().to_owned();
    act(&mut app, folder(ManyCommand::SaveResults(into.clone())));
    assert!(
        app.state()
            .messages
            .iter()
            .any(|m| m.text.contains("once all open clouds are evaluated"))
    );
    act(&mut app, folder(ManyCommand::Evaluate));
    let ranges = SweepRanges {
        u: [5, 7],
        tau_cm_per_rad: [0.0, 1.0],
        tau_step_cm_per_rad: 0.5,
        ..SweepRanges::default()
    };
    act(&mut app, folder(ManyCommand::SweepRanges(Box::new(ranges))));
    act(&mut app, folder(ManyCommand::Sweep));
    assert_eq!(app.state().many.sweep.clouds, [3, 4]);
    for _ in 0..2 {
        act(&mut app, folder(ManyCommand::SaveResults(into.clone())));
    }
    let saved = into.join("axiscope-results");
    assert!(
        into.join("axiscope-results-2").join("results.csv").exists(),
        "nothing is written over"
    );

    let words = evaluate_command_line(app.state()).expect("files are open");
    let place = words.iter().position(|word| word == "--out").expect("an output");
    let mut words: Vec<String> = words[1..].to_vec();
    let other = into.join("by command");
    words[place] = other.display().to_string();
    let ran = command_line::run(&words);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let mut names: Vec<_> = std::fs::read_dir(&saved)
        .expect("saved")
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    names.sort();
    assert!(names.len() >= 8, "{names:?}");
    for name in names {
        let read = |folder: &Path| std::fs::read(folder.join(&name)).expect("both have it");
        // Means are added up in another order.
        if name == "sweep.csv" || name.to_string_lossy().starts_with("sweep.") {
            continue;
        }
        if name == "report.html" {
            let text = |folder: &Path| String::from_utf8(read(folder)).expect("text").len();
            assert_eq!(text(&saved), text(&other));
        } else {
            assert!(read(&saved) == read(&other), "{name:?} differs");
        }
    }
    let table = std::fs::read_to_string(saved.join("results.csv")).expect("a table");
    assert!(table.contains("leaf,odd"), "{table}");
    let sweep = |folder: &Path| -> Vec<f64> {
        let mut table = csv::Reader::from_path(folder.join("sweep.csv")).expect("a table");
        table
            .records()
            .map(|r| r.expect("a row")[3].parse().expect("a mean"))
            .collect()
    };
    for (a, b) in sweep(&saved).into_iter().zip(sweep(&other)) {
        assert!((a - b).abs() < 1e-9, "{a} and {b}");
    }
}

#[test]
fn sort_filter_and_sweep_survive_a_restart() {
    let dir = TempDir::new().expect("a folder");
    write_peppers(dir.path(), 2);
    let mut app = app();
    act(&mut app, Command::Open(vec![dir.path().to_owned()]));
    let sort = Sort {
        by: Column::Lead,
        is_descending: true,
    };
    act(&mut app, folder(ManyCommand::Sort(sort)));
    let filter = Filter {
        search: "pepper".into(),
        above_deg: Some(1.5),
        ..Filter::default()
    };
    act(&mut app, folder(ManyCommand::Filter(Box::new(filter))));
    act(&mut app, Command::Compare(TruthChoice::Truth));
    assert_eq!(app.state().many.folders, [dir.path()]);
    let path = dir.path().join("session.json");
    Session::of(app.state()).write(&path).expect("it can be kept");
    let kept = Session::read(&path).expect("it was kept");
    assert_eq!(kept.many.folders(), [dir.path()]);
    act(&mut app, Command::Close);
    assert!(
        Session::of(app.state()).many.folders().is_empty(),
        "not as a whole any more"
    );
    let again = App::new(
        Session::read(&path).expect("it was kept"),
        &(std::sync::Arc::new(|| {}) as _),
    );
    let state = again.expect("threads can be started").state().many.clone();
    assert_eq!(
        (state.sort, &state.filter, state.against),
        (sort, &app.state().many.filter, TruthChoice::Truth)
    );
}

#[test]
fn table_view_and_planes_measure_against_one_reference() {
    let dir = TempDir::new().expect("a folder");
    write_peppers(dir.path(), 2);
    let mut app = opened(dir.path(), &dir.path().join("cache"));
    act(&mut app, Command::Show(0));
    let mut errors = Vec::new();
    for choice in [
        TruthChoice::Auto,
        TruthChoice::Peduncle,
        TruthChoice::PeduncleDirection,
        TruthChoice::Truth,
        TruthChoice::Manual,
    ] {
        act(&mut app, Command::Compare(choice));
        let state = app.state();
        let in_table = state.many.rows[0].error_deg(state.many.against);
        let axis = state.analysis().and_then(|a| a.axis.clone()).expect("an axis");
        let reference = state.reference();
        let in_view = reference.map(|r| axiscope::method::axis_error_rad(&axis, r).to_degrees());
        assert_eq!(in_table, in_view, "{choice:?}");
        let drawn = state.look.as_ref().and_then(|look| look.reference.clone());
        assert_eq!(drawn.as_ref(), reference, "{choice:?}");
        errors.push(in_view);
    }
    assert_eq!(errors[0], errors[3], "the best known one is the simulator's");
    assert_ne!(errors[1], errors[3], "they are told apart");
    assert_eq!(
        errors[4], None,
        "nobody has set one, and no other takes its place"
    );
}

/// A row of an outcome that never was.
fn made_up(error_deg: Option<f64>, points: u64, name: &str, tag: bool) -> TableRow {
    let mut row = Row::failed(name, "there is no reference axis".into());
    row.points = Some(points);
    row.sha256 = Some("0".into());
    row.axis = Some([0.0, 1.0, 0.0]);
    let known = error_deg
        .map(|e| serde_json::json!({"name": "peduncle", "direction": [0.0, 1.0, 0.0], "error_deg": e}));
    let outcome = serde_json::json!({"row": row, "peduncle": known, "truth": null, "manual": null});
    let outcome = serde_json::from_value(outcome).expect("an outcome");
    TableRow {
        name: name.into(),
        path: None,
        outcome: Some(std::sync::Arc::new(outcome)),
        is_stale: false,
        tagged: CloudTags::default().with_tags(if tag { "leaf" } else { "" }),
        cells: std::sync::Arc::default(),
    }
}

proptest! {
    #[test]
    fn order_is_a_sorted_part_of_all_that_passes(
        rows in prop::collection::vec((prop::option::of(0.0..90.0_f64), 0..5_u64, "[ab]{1,3}", any::<bool>()), 0..40),
        is_descending in any::<bool>(),
        by in prop::sample::select(vec![Column::PeduncleError, Column::Points, Column::Name, Column::Opened]),
        above in prop::option::of(0.0..90.0_f64),
        only_failed in any::<bool>(),
        tag in any::<bool>(),
        search in "[ab]{0,1}",
    ) {
        let rows: Vec<TableRow> = rows.into_iter().map(|(e, p, n, t)| made_up(e, p, &n, t)).collect();
        let filter = Filter { search: search.clone(), only_failed, above_deg: above, tag: tag.then(|| "leaf".into()), ..Filter::default() };
        let choice = TruthChoice::Peduncle;
        let order = ordered(&rows, Sort { by, is_descending }, &filter, choice);
        let passes = |row: &TableRow| {
            row.name.contains(&search) | row.tagged.tags.iter().any(|t| t.contains(&search))
                && (!only_failed || row.error_deg(choice).is_none())
                && above.is_none_or(|a| row.error_deg(choice).is_some_and(|e| e > a))
                && (!tag || !row.tagged.tags.is_empty())
        };
        // Each once, and all that pass.
        let mut places = order.clone();
        places.sort_unstable();
        prop_assert_eq!(places, (0..rows.len()).filter(|&i| passes(&rows[i])).collect::<Vec<_>>());
        let value = |&i: &usize| match by {
            Column::PeduncleError => rows[i].error_deg(choice),
            Column::Points => rows[i].outcome.as_ref().unwrap().row().points.map(|p| p as f64),
            Column::Opened => Some(i as f64),
            _ => None,
        };
        let values: Vec<Option<f64>> = order.iter().map(value).collect();
        for pair in values.windows(2) {
            match (pair[0], pair[1]) {
                (Some(a), Some(b)) => prop_assert!((a <= b) != is_descending || a == b),
                (None, Some(_)) => prop_assert!(false, "those without a value come last"),
                _ => {}
            }
        }
        if by == Column::Name {
            let names: Vec<&str> = order.iter().map(|&i| rows[i].name.as_str()).collect();
            let is_right = names.is_sorted_by(|a, b| if is_descending { a >= b } else { a <= b });
            prop_assert!(is_right);
        }
    }
}
