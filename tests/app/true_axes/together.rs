//! Blind mode, several annotators, and the way through many clouds.

use super::*;
#[test]
fn starts_are_recorded_for_good_and_refused_in_blind_mode() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    annotate(&mut app, TrueAxesCommand::Start(Method::FromComputed));
    let computed = app
        .state()
        .analysis()
        .and_then(|a| a.axis.clone())
        .expect("an axis");
    let ends = app.state().true_axes.set_ends().expect("an axis");
    assert!(ends.direction().cross(computed.direction).length() < 1e-9);
    annotate(&mut app, TrueAxesCommand::Nudge(Turn::Lean, 5.0));
    annotate(&mut app, TrueAxesCommand::Confidence(Some(Confidence::HIGH)));
    annotate(&mut app, TrueAxesCommand::Note("dented".into()));
    annotate(&mut app, TrueAxesCommand::Flip);
    let annotation = on_disk(&paths[0], &ada()).expect("a file");
    assert_eq!(
        annotation.judgment.method,
        Method::FromComputed,
        "nudging does not change that"
    );
    assert_eq!(annotation.judgment.confidence, Some(Confidence::HIGH));
    assert_eq!(annotation.judgment.note, "dented");
    annotate(&mut app, TrueAxesCommand::Start(Method::FromPeduncle));
    let steps = app.state().true_axes.history.undo_steps();
    annotate(&mut app, TrueAxesCommand::Blind(true));
    annotate(&mut app, TrueAxesCommand::Start(Method::FromComputed));
    assert_eq!(
        app.state().true_axes.history.undo_steps(),
        steps,
        "hidden in blind mode"
    );
    assert_eq!(
        on_disk(&paths[0], &ada()).expect("a file").judgment.method,
        Method::FromPeduncle
    );
    annotate(&mut app, TrueAxesCommand::CannotTell);
    let annotation = on_disk(&paths[0], &ada()).expect("a file");
    assert_eq!(annotation.judgment.ends, None);
    assert_eq!(
        app.state().true_axes.next_end(),
        None,
        "a click does not undo that by accident"
    );
    annotate(&mut app, TrueAxesCommand::Anew);
    assert_eq!(app.state().true_axes.next_end(), Some(Handle::PeduncleBase));
}

#[test]
fn blind_mode_hides_everything_computed() {
    let (_folder, paths) = folder(2);
    let mut app = app();
    app.set_view(Viewport::new(900.0, 700.0), 1.0, true);
    annotate(&mut app, TrueAxesCommand::Blind(true));
    act(&mut app, Command::Open(paths.clone()));
    let look = app.state().look.clone().expect("drawn");
    assert!(look.axis.is_none() && look.reference.is_none() && look.detail.is_none());
    assert!(look.plane_index.is_none() && look.scene.polygons.is_empty() && look.scene.lines.is_empty());
    let style = app.state().shown_style();
    assert_eq!(style.coloring, Coloring::Rgb, "the side of the plane is hidden");
    for overlay in [
        Overlay::Axis,
        Overlay::Plane,
        Overlay::Reference,
        Overlay::Caption,
    ] {
        assert!(!style.overlays.has(overlay));
    }
    let camera = app.state().camera;
    for command in [
        Command::View(ViewPreset::Axis),
        Command::View(ViewPreset::Normal),
        Command::Step(1),
        Command::TrueAxes(TrueAxesCommand::ShowAll(true)),
    ] {
        act(&mut app, command);
    }
    assert_eq!(app.state().camera, camera, "no view gives the axis away");
    assert!(!app.state().true_axes.shows_all);

    annotate(&mut app, TrueAxesCommand::Edit(true));
    annotate(&mut app, TrueAxesCommand::Name("Ada".into()));
    set_by_clicks(&mut app);
    assert!(on_disk(&paths[0], &ada()).expect("a file").judgment.blind);
    // Whoever has once seen what is computed is not blind any more.
    annotate(&mut app, TrueAxesCommand::Blind(false));
    assert!(app.state().look.as_ref().expect("drawn").axis.is_some());
    annotate(&mut app, TrueAxesCommand::Blind(true));
    assert!(app.state().true_axes.was_seen);
    annotate(&mut app, TrueAxesCommand::Flip);
    assert!(!on_disk(&paths[0], &ada()).expect("a file").judgment.blind);
    // The next cloud was not seen.
    act(&mut app, Command::Go(1));
    assert!(!app.state().true_axes.was_seen && app.state().true_axes.can_edit());
    set_by_clicks(&mut app);
    assert!(on_disk(&paths[1], &ada()).expect("a file").judgment.blind);
}

#[test]
fn results_that_a_panel_showed_are_never_forgotten() {
    let (folder, paths) = folder(3);
    let seen = folder.path().join("state").join("seen.txt");
    let mut app = app();
    app.keep_seen_in(seen.clone());
    act(&mut app, Command::Open(paths.clone()));
    act(&mut app, Command::Many(ManyCommand::Evaluate));
    assert!(app.state().many.rows.iter().all(|row| row.outcome.is_some()));
    // Nothing of the other two was on the screen yet.
    let kept = || {
        std::fs::read_to_string(&seen)
            .expect("a file")
            .split_whitespace()
            .count()
    };
    assert_eq!(kept(), 1);
    assert!(app.state().has_unseen_results());
    annotate(&mut app, TrueAxesCommand::ResultsShown);
    assert!(!app.state().has_unseen_results());
    assert_eq!(kept(), 3);
    drop(app);

    // Another day, blind from the start.
    let mut session = Session::first();
    session.true_axes.is_blind = true;
    session.true_axes.name = "Ada".into();
    let blind_at = |seen: Option<PathBuf>, cloud: &Path| {
        let mut app = App::new(session.clone(), &(std::sync::Arc::new(|| {}) as _)).expect("threads");
        if let Some(seen) = seen {
            app.keep_seen_in(seen);
        }
        app.set_view(Viewport::new(900.0, 700.0), 1.0, true);
        act(&mut app, Command::Open(vec![cloud.to_owned()]));
        annotate(&mut app, TrueAxesCommand::Edit(true));
        set_by_clicks(&mut app);
        on_disk(cloud, &ada()).expect("a file").judgment.blind
    };
    assert!(!blind_at(Some(seen), &paths[1]), "the table showed its error");
    assert!(
        blind_at(None, &paths[2]),
        "without that file it would be said to be blind"
    );
}

#[test]
fn annotators_go_through_the_clouds_in_the_order_of_the_list() {
    let (_folder, paths) = folder(3);
    let mut app = editing(&paths);
    let sort = Sort {
        by: Column::Opened,
        is_descending: true,
    };
    act(&mut app, Command::Many(ManyCommand::Sort(sort)));
    let filter = Filter {
        search: "pepper2".into(),
        ..Filter::default()
    };
    act(&mut app, Command::Many(ManyCommand::Filter(Box::new(filter))));
    act(&mut app, Command::Show(0));
    act(&mut app, Command::Go(1));
    assert_eq!(
        app.state().current,
        Some(1),
        "not as yesterday's sort and filter have it"
    );
    annotate(&mut app, TrueAxesCommand::Edit(false));
    act(&mut app, Command::Go(1));
    assert_eq!(
        app.state().current,
        Some(2),
        "elsewhere the table's order is followed"
    );
    annotate(&mut app, TrueAxesCommand::Blind(true));
    act(&mut app, Command::Go(-1));
    assert_eq!(app.state().current, Some(1));
    act(&mut app, Command::Many(ManyCommand::GoWorse(1)));
    assert_eq!(
        app.state().current,
        Some(1),
        "an order by error would tell something"
    );
}

/// An axis of somebody else, written by the library.
fn set_as(author: &Author, cloud: &Path, ends: Ends) {
    let fruit = axiscope::fruit::Fruit::read(cloud, &axiscope::fruit::Request::default()).expect("a cloud");
    let id = axiscope::annotate::CloudId {
        file: cloud.file_name().expect("a name").to_string_lossy().into(),
        sha256: fruit.file.sha256.clone(),
    };
    let files = Box::new(axiscope::annotate::DiskFiles::default());
    let (mut store, _) =
        axiscope::annotate::Store::open(files, cloud, id, fruit.unit, author.clone()).expect("open");
    store
        .edit(Judgment::by_hand(ends), "2026-03-01T12:00:00Z")
        .expect("written");
}

#[test]
fn annotators_are_compared_and_decided_between() {
    let (_folder, paths) = folder(3);
    let mut app = editing(&paths);
    let ends = set_by_clicks(&mut app);
    drop(app);
    let turned = |degrees| ends.turned(DVec3::Z, degrees, Pivot::Middle).expect("an axis");
    for (name, degrees) in [("Ben", 4.0), ("Cleo", 40.0)] {
        set_as(
            &Author::annotator(name).expect("a name"),
            &paths[0],
            turned(degrees),
        );
    }
    let mut app = editing(&paths);
    let agreement = app.state().true_axes.agreement.clone().expect("compared");
    assert_eq!(agreement.pairs.len(), 3);
    assert_eq!(agreement.far_off, ["Cleo"]);
    // Each is a reference under a name of its own.
    let cleo = AxisSource::Annotator("Cleo".into());
    assert!(app.state().references.iter().any(|axis| axis.source == cleo));
    act(&mut app, Command::Compare(TruthChoice::Peduncle));
    assert_eq!(app.state().reference().expect("one").source, AxisSource::Peduncle);

    annotate(&mut app, TrueAxesCommand::Decide(Decision::Of("Ben".into())));
    assert_eq!(app.state().true_axes.role, Role::Adjudicator);
    assert_eq!(app.state().true_axes.set_ends(), Some(turned(4.0)));
    annotate(&mut app, TrueAxesCommand::Decide(Decision::Mean));
    let adjudicator = Author::adjudicator("Ada").expect("a name");
    let annotation = on_disk(&paths[0], &adjudicator).expect("a file");
    assert_eq!(annotation.role, Role::Adjudicator);
    let mean = agreement.mean.expect("a mean").direction;
    assert!((annotation.ends().expect("an axis").direction() - mean).length() < 1e-9);
    let adjudicated = |axis: &axiscope::method::AxisEstimate| axis.source == AxisSource::Adjudicated;
    assert!(
        app.state().references.iter().any(adjudicated),
        "it is a reference at once"
    );
    assert_eq!(app.state().true_axes.history.undo_steps(), 2);
    // Leaving edit mode ends the role.
    annotate(&mut app, TrueAxesCommand::Edit(false));
    assert_eq!(app.state().true_axes.role, Role::Annotator);

    annotate(&mut app, TrueAxesCommand::CompareSet);
    let set = app.state().true_axes.set.clone().expect("compared");
    assert_eq!(set.agreement.clouds.len(), 3);
    assert_eq!(set.agreement.annotators.len(), 3);
    assert_eq!(set.agreement.clouds[0].largest_deg, agreement.largest_deg);
}

#[test]
fn the_loop_goes_from_cloud_to_cloud() {
    let (_folder, paths) = folder(4);
    let mut app = editing(&paths);
    assert_eq!(app.state().true_axes.progress(), Some((0, 4)));
    set_by_clicks(&mut app);
    assert_eq!(app.state().true_axes.progress(), Some((1, 4)));
    act(&mut app, Command::Go(1));
    assert!(app.state().true_axes.can_edit(), "edit mode stays");
    assert!(app.state().true_axes.judgment().is_none() && app.state().true_axes.draft == Draft::None);
    click(&mut app, BASE_PX);
    annotate(&mut app, TrueAxesCommand::NextWithout);
    assert_eq!(app.state().current, Some(2));
    assert_eq!(
        app.state().true_axes.draft,
        Draft::None,
        "half an axis does not follow"
    );
    set_by_clicks(&mut app);
    annotate(&mut app, TrueAxesCommand::NextWithout);
    assert_eq!(app.state().current, Some(3));
    set_by_clicks(&mut app);
    annotate(&mut app, TrueAxesCommand::NextWithout);
    assert_eq!(app.state().current, Some(1), "the one that was left out");
    annotate(&mut app, TrueAxesCommand::CannotTell);
    assert_eq!(app.state().true_axes.progress(), Some((4, 4)));
    annotate(&mut app, TrueAxesCommand::NextWithout);
    assert_eq!(app.state().current, Some(1));
    drop(app);
    let app = editing(&paths);
    assert_eq!(
        app.state().true_axes.progress(),
        Some((4, 4)),
        "told from the files"
    );
}

#[test]
fn the_table_knows_an_axis_as_soon_as_it_is_set() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let row = |app: &App| {
        let outcome = app.state().many.rows[0].outcome.clone().expect("evaluated");
        outcome.row().clone()
    };
    assert_eq!(row(&app).manual_error_deg, None);
    let ends = set_by_clicks(&mut app);
    let computed = app
        .state()
        .analysis()
        .and_then(|a| a.axis.clone())
        .expect("an axis");
    let between = computed.direction.dot(ends.direction()).abs().acos().to_degrees();
    let error = row(&app).manual_error_deg.expect("measured");
    assert!((error - between).abs() < 1e-6, "{error} {between}");
    assert_eq!(row(&app).annotators, "Ada");
    annotate(&mut app, TrueAxesCommand::Undo);
    assert_eq!(row(&app).manual_error_deg, None);
}

#[test]
fn one_tool_at_a_time_has_the_left_button() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    act(&mut app, Command::Use(Tool::Lasso));
    assert!(!app.state().true_axes.is_editing);
    assert_eq!(app.state().tool, Tool::Lasso);
    annotate(&mut app, TrueAxesCommand::Edit(true));
    assert!(app.state().true_axes.is_editing);
    assert_eq!(app.state().tool, Tool::Navigate);
}

#[test]
fn an_axis_that_is_set_is_drawn_among_all_references_at_once() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let mut style = app.state().style.clone();
    style.overlays.set(Overlay::References, true);
    act(&mut app, Command::Style(Box::new(style)));
    let lines = |app: &App| app.state().look.as_ref().expect("drawn").scene.lines.len();
    let before = lines(&app);
    set_by_clicks(&mut app);
    assert!(lines(&app) > before, "{} and {before}", lines(&app));
}
