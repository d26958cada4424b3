//! What is saved, what is not and is told, and what a new program finds.

use super::*;
#[test]
fn undo_and_redo_survive_a_new_program() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let first = set_by_clicks(&mut app);
    for _ in 0..5 {
        annotate(&mut app, TrueAxesCommand::Nudge(Turn::Picture, 1.0));
    }
    for _ in 0..2 {
        annotate(&mut app, TrueAxesCommand::Undo);
    }
    let left = app.state().true_axes.set_ends();
    drop(app);

    let mut app = editing(&paths);
    let history = &app.state().true_axes.history;
    assert_eq!((history.undo_steps(), history.redo_steps()), (4, 2));
    let ends = app.state().true_axes.set_ends();
    // Files keep as many digits as a number has.
    assert_eq!(ends, left);
    for _ in 0..3 {
        annotate(&mut app, TrueAxesCommand::Undo);
    }
    assert_eq!(app.state().true_axes.set_ends(), Some(first));
    annotate(&mut app, TrueAxesCommand::Undo);
    assert!(app.state().true_axes.judgment().is_none());
    assert!(on_disk(&paths[0], &ada()).is_none(), "what was undone is gone");
    for _ in 0..6 {
        annotate(&mut app, TrueAxesCommand::Redo);
    }
    let angle = app
        .state()
        .true_axes
        .set_ends()
        .expect("an axis")
        .angle_to_deg(&first);
    // Each turn is about a direction across the axis as it was.
    assert!((angle - 5.0).abs() < 1e-3, "{angle}");
}

#[test]
fn edits_are_written_before_the_program_ends() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    set_by_clicks(&mut app);
    // As fast as a held key, without a frame in between.
    for _ in 0..60 {
        app.apply(Command::TrueAxes(TrueAxesCommand::Nudge(Turn::Lean, 0.1)));
    }
    assert_eq!(app.state().true_axes.saving, Saving::Saving);
    let shown = app.state().true_axes.set_ends();
    drop(app);
    assert_eq!(on_disk(&paths[0], &ada()).expect("a file").ends().copied(), shown);

    let mut app = editing(&paths);
    set_by_clicks(&mut app);
    app.apply(Command::TrueAxes(TrueAxesCommand::Flip));
    app.finish();
    assert_eq!(app.state().true_axes.saving, Saving::Saved);
}

#[cfg(unix)]
#[test]
fn what_cannot_be_written_is_told_at_once_and_kept() {
    let (folder, paths) = folder(2);
    // A journal that is a folder: nothing can be appended to it, whoever runs this.
    let journal = ada().journal_path(&paths[0], 1);
    let axis = ada().axis_path(&paths[0], 1).with_extension("json.probe");
    std::fs::create_dir_all(axis.join("x")).expect("a folder");
    let mut app = editing(&paths);
    let Saving::Failed(problem) = app.state().true_axes.saving.clone() else {
        panic!("told before anything is set: {:?}", app.state().true_axes.saving);
    };
    assert!(problem.contains("pepper0.Ada.axis.json"), "{problem}");
    std::fs::remove_dir_all(&axis).expect("removed");
    let tmp = folder.path().join("pepper0.Ada.axis.json.tmp");
    std::fs::create_dir_all(tmp.join("x")).expect("a folder");
    let ends = set_by_clicks(&mut app);
    assert!(matches!(app.state().true_axes.saving, Saving::Failed(_)));
    assert_eq!(
        app.state().true_axes.set_ends(),
        Some(ends),
        "it is shown all the same"
    );
    assert!(app.state().true_axes.has_failed() && on_disk(&paths[0], &ada()).is_none());
    // Another cloud does not push it out.
    act(&mut app, Command::Go(1));
    assert_eq!(app.state().true_axes.unsaved_elsewhere, [paths[0].clone()]);
    assert!(app.state().true_axes.has_failed());
    set_by_clicks(&mut app);
    assert_eq!(app.state().true_axes.saving, Saving::Saved);
    act(&mut app, Command::Go(-1));
    assert_eq!(app.state().true_axes.set_ends(), Some(ends));
    std::fs::remove_dir_all(&tmp).expect("removed");
    annotate(&mut app, TrueAxesCommand::TryAgain);
    assert_eq!(app.state().true_axes.saving, Saving::Saved);
    assert_eq!(
        on_disk(&paths[0], &ada()).expect("a file").ends().copied(),
        Some(ends)
    );
    assert!(journal.exists() && !app.state().true_axes.has_failed());
}

#[test]
fn a_cloud_that_another_program_annotates_waits() {
    let (_folder, paths) = folder(1);
    let mut first = editing(&paths);
    set_by_clicks(&mut first);
    let mut second = editing(&paths);
    assert!(
        matches!(&second.state().true_axes.saving, Saving::Failed(why) if why.contains("another program"))
    );
    set_by_clicks(&mut second);
    annotate(&mut second, TrueAxesCommand::Flip);
    let wanted = second.state().true_axes.set_ends();
    assert!(second.state().true_axes.has_failed() && wanted.is_some());
    drop(first);
    annotate(&mut second, TrueAxesCommand::TryAgain);
    assert_eq!(second.state().true_axes.saving, Saving::Saved);
    assert_eq!(second.state().true_axes.set_ends(), wanted);
    assert_eq!(
        on_disk(&paths[0], &ada()).expect("a file").ends().copied(),
        wanted
    );
    assert_eq!(
        second.state().true_axes.history.undo_steps(),
        3,
        "the first one's edit is before them"
    );
}

#[test]
fn files_that_must_not_be_touched_are_told() {
    let (_folder, paths) = folder(1);
    let other = ada().axis_path(&paths[0], 1);
    std::fs::write(&other, "{\"half\": ").expect("written");
    let mut app = editing(&paths);
    assert!(
        app.state()
            .true_axes
            .notices
            .iter()
            .any(|notice| notice.contains("is left as it is")),
        "{:?}",
        app.state().true_axes.notices
    );
    set_by_clicks(&mut app);
    assert_eq!(std::fs::read_to_string(&other).expect("there"), "{\"half\": ");
    let beside = app.state().true_axes.axis_file.clone().expect("a file");
    assert!(beside.ends_with("pepper0.Ada.2.axis.json") && beside.exists());
}

#[test]
fn a_sample_has_no_folder_for_an_axis() {
    let mut app = app();
    act(&mut app, Command::OpenSample(Sample::Pepper));
    annotate(&mut app, TrueAxesCommand::Edit(true));
    assert!(!app.state().true_axes.is_editing && !app.state().true_axes.asks_name);
    assert!(
        app.state()
            .messages
            .iter()
            .any(|message| message.text.contains("lies in no folder"))
    );
}

#[test]
fn the_name_and_blindness_are_kept_in_the_session() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    annotate(&mut app, TrueAxesCommand::Blind(true));
    annotate(&mut app, TrueAxesCommand::Step(2));
    let session = Session::of(app.state());
    let again = App::new(session, &(std::sync::Arc::new(|| {}) as _)).expect("threads start");
    let annotating = &again.state().true_axes;
    assert_eq!(annotating.name, "Ada");
    assert!(annotating.is_blind && !annotating.is_editing);
    assert_eq!(annotating.step_deg(), 5.0);
}

#[test]
fn a_name_that_cannot_be_one_begins_nothing() {
    let (_folder, paths) = folder(1);
    let mut app = app();
    act(&mut app, Command::Open(paths));
    annotate(&mut app, TrueAxesCommand::Edit(true));
    annotate(&mut app, TrueAxesCommand::Name("12".into()));
    assert!(!app.state().true_axes.is_editing && app.state().true_axes.asks_name);
    annotate(&mut app, TrueAxesCommand::WithoutName);
    assert!(!app.state().true_axes.asks_name);
    settle(&mut app);
    app.update(Duration::ZERO);
}

#[test]
fn a_cloud_that_cannot_be_analyzed_can_be_annotated() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("few.ply");
    let head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    std::fs::write(&path, format!("{head}0 0 50\n0 4 51\n")).expect("written");
    let mut app = editing(std::slice::from_ref(&path));
    assert!(app.state().walked.is_none() && app.state().look.is_some());
    set_by_clicks(&mut app);
    assert!(on_disk(&path, &ada()).is_some());
    annotate(&mut app, TrueAxesCommand::Start(Method::FromComputed));
    assert!(
        app.state()
            .messages
            .iter()
            .any(|message| message.text.contains("not analyzed"))
    );
}

#[test]
fn a_large_cloud_s_axis_can_be_set_before_it_is_analyzed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("large.ply");
    let count = 120_000;
    let head = format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
         end_header\n"
    );
    let point = |i: u32| {
        let (turn, height) = (
            f64::from(i) * 2.399_963,
            f64::from(i) / f64::from(count) * 2.0 - 1.0,
        );
        let radius = 4.0 * (1.0 - height * height).sqrt();
        format!(
            "{} {} {}\n",
            radius * turn.cos(),
            4.0 * height,
            50.0 - (radius * turn.sin()).abs()
        )
    };
    std::fs::write(&path, head + &(0..count).map(point).collect::<String>()).expect("written");
    let mut app = app();
    app.set_view(Viewport::new(900.0, 700.0), 1.0, true);
    app.apply(Command::Open(vec![path.clone()]));
    app.apply(Command::TrueAxes(TrueAxesCommand::Edit(true)));
    app.apply(Command::TrueAxes(TrueAxesCommand::Name("Ada".into())));
    let began = std::time::Instant::now();
    while !app.state().true_axes.can_edit() {
        app.update(Duration::from_millis(16));
        std::thread::sleep(Duration::from_millis(1));
        assert!(began.elapsed() < Duration::from_mins(1), "it never comes");
    }
    assert!(
        app.state().walked.is_none() && app.state().progress.is_some(),
        "not analyzed yet"
    );
    app.apply(Command::TrueAxes(TrueAxesCommand::Place(DVec3::new(
        0.0, -4.0, 50.0,
    ))));
    app.apply(Command::TrueAxes(TrueAxesCommand::Place(DVec3::new(
        0.0, 4.0, 50.0,
    ))));
    let ends = app.state().true_axes.set_ends();
    assert!(ends.is_some());
    app.apply(Command::Cancel);
    settle(&mut app);
    assert_eq!(on_disk(&path, &ada()).expect("a file").ends().copied(), ends);
    act(&mut app, Command::Resume);
    assert!(app.state().walked.is_some());
    assert_eq!(
        app.state().true_axes.set_ends(),
        ends,
        "the analysis does not touch it"
    );
}
