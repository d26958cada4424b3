//! Strokes, growing, undo, and what is shown of them.

use super::*;

#[test]
fn a_lasso_around_the_peduncle_of_a_bare_cloud_gives_its_references() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    assert!(app.state().references.is_empty(), "nothing tells its peduncle");
    act(&mut app, Command::Use(Tool::Lasso));
    assert_eq!(highlighted(&app), 0);
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let found = fruit(&app).peduncle.clone();
    let found = found.expect("picked");
    assert_eq!(found.source, PeduncleSource::Picked);
    assert_eq!(found.in_cloud, picked(&app).iter().collect::<Vec<_>>());
    assert!(
        labeled().iter().all(|i| picked(&app).contains(i)),
        "all that was gone around"
    );
    assert_eq!(highlighted(&app), found.points);
    let sources: Vec<_> = app.state().references.iter().map(|r| r.source.clone()).collect();
    assert_eq!(sources, [AxisSource::Peduncle, AxisSource::PeduncleDirection]);
    assert!(app.state().peduncle.strokes.is_empty() && !app.state().is_stale);
}

#[test]
fn a_stroke_shows_before_the_button_is_let_go_and_is_one_step_of_undo() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    act(&mut app, Command::Use(Tool::Brush));
    ask(&mut app, PeduncleCommand::BrushRadius(30.0));
    let path = around(&app, &labeled());
    for &at_px in &path {
        act(
            &mut app,
            Command::Peduncle(PeduncleCommand::Draw {
                at_px,
                removes: false,
            }),
        );
    }
    assert!(highlighted(&app) > 10, "{}", highlighted(&app));
    assert_eq!(choice(&app), PeduncleChoice::Auto, "nothing is analyzed yet");
    assert!(!app.state().can_undo);
    ask(&mut app, PeduncleCommand::EndStroke);
    let first = picked(&app);
    let second = around(&app, &first);
    drag(&mut app, true, &second[..2]);
    assert!(picked(&app).len() < first.len());
    act(&mut app, Command::Undo);
    assert_eq!(picked(&app), first);
    act(&mut app, Command::Undo);
    assert_eq!(choice(&app), PeduncleChoice::Auto);
    assert!(!app.state().can_undo);
    act(&mut app, Command::Redo);
    assert_eq!(picked(&app), first);
}

#[test]
fn a_stroke_that_is_dropped_or_changes_nothing_is_no_step() {
    let mut app = with_sample();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::Use(Tool::Lasso));
    let before = app.state().settings.clone();
    drag(
        &mut app,
        false,
        &[DVec2::new(3.0, 3.0), DVec2::new(9.0, 3.0), DVec2::new(5.0, 9.0)],
    );
    assert_eq!(app.state().settings, before, "nothing is in the corner");
    for at in [(100.0, 100.0), (700.0, 100.0), (400.0, 500.0)] {
        let at_px = DVec2::from(at);
        act(
            &mut app,
            Command::Peduncle(PeduncleCommand::Draw {
                at_px,
                removes: false,
            }),
        );
    }
    let count = labeled().len();
    assert!(highlighted(&app) > count);
    ask(&mut app, PeduncleCommand::DropStroke);
    assert_eq!(highlighted(&app), count, "the labels' peduncle is back");
    assert_eq!(app.state().settings, before);
    assert!(!app.state().can_undo);
}

#[test]
fn picking_begins_with_the_peduncle_that_there_is() {
    let mut app = with_sample();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::View(ViewPreset::Camera));
    act(&mut app, Command::Use(Tool::Lasso));
    assert_eq!(highlighted(&app), labeled().len());
    // Nothing of the fruit is near its peduncle here: half of it grows into the other half.
    let half: PointSet = labeled().iter().step_by(2).collect();
    pick(&mut app, &half);
    ask(&mut app, PeduncleCommand::Grow);
    let grown = picked(&app);
    assert!(half.iter().all(|i| grown.contains(i)) && grown.len() > half.len());
    assert!(grown.iter().all(|i| labeled().contains(i)));
    pick(&mut app, &half);
    ask(&mut app, PeduncleCommand::Shrink);
    assert!(picked(&app).iter().all(|i| half.contains(i)) && picked(&app).len() < half.len());
    // Pressed quickly, each press counts.
    let few: PointSet = labeled().iter().take(1).collect();
    let mut sizes = Vec::new();
    for presses in [1, 3] {
        pick(&mut app, &few);
        for _ in 0..presses {
            app.apply(Command::Peduncle(PeduncleCommand::Grow));
        }
        settle(&mut app);
        sizes.push(picked(&app).len());
    }
    assert!(1 < sizes[0] && sizes[0] < sizes[1], "{sizes:?}");
    while app.state().can_undo {
        act(&mut app, Command::Undo);
    }
    assert_eq!(choice(&app), PeduncleChoice::Auto);
    let count = app.state().shown().expect("points").len();
    ask(&mut app, PeduncleCommand::Invert);
    assert_eq!(picked(&app).len(), count - labeled().len());
    ask(&mut app, PeduncleCommand::Clear);
    assert!(picked(&app).is_empty() && fruit(&app).peduncle.is_none());
}

#[test]
fn what_is_picked_belongs_to_its_cloud_alone() {
    let folder = TempDir::new().expect("a folder");
    let bare = bare_pepper(&folder);
    let mut app = open(&bare);
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let first = picked(&app);
    act(&mut app, Command::Open(vec![asset("pepper.ply")]));
    assert_eq!(app.state().picked_peduncle(), None);
    let fruit = fruit(&app);
    assert_eq!(
        fruit.peduncle.as_ref().map(|p| p.source),
        Some(PeduncleSource::Label)
    );
    ask(&mut app, PeduncleCommand::Invert);
    assert!(picked(&app).len() > labeled().len());
    act(&mut app, Command::Go(-1));
    assert_eq!(picked(&app), first, "the first one's is still there");
    // And after a restart.
    let text = serde_json::to_string(&Session::of(app.state())).expect("plain data");
    let back: Session = serde_json::from_str(&text).expect("its own text");
    assert_eq!(back.settings, app.state().settings);
    assert!(
        text.len() < 20_000,
        "{} bytes: runs of points stay short",
        text.len()
    );
}

#[test]
fn the_label_coloring_shows_what_was_picked() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    let mut style = app.state().style.clone();
    style.coloring = Coloring::Label;
    act(&mut app, Command::Style(Box::new(style)));
    assert!(
        app.state().look.as_ref().expect("drawn").fallback.is_some(),
        "no labels"
    );
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let look = app.state().look.clone().expect("drawn");
    assert!(look.fallback.is_none());
    let swatch = look
        .legend
        .swatches
        .iter()
        .find(|s| s.label == "peduncle")
        .expect("it is told");
    assert_eq!(swatch.count.map(|c| c.0), Some(picked(&app).len()));
}

#[test]
fn a_voxel_grid_highlights_what_stands_for_picked_points() {
    let mut app = with_sample();
    let mut request = app.state().settings.request.clone();
    request.params.filters.voxel_cm = Some(0.3);
    set(&mut app, |now| *now = request);
    act(&mut app, Command::Use(Tool::Lasso));
    let shown = app.state().shown().expect("points").clone();
    let in_file = shown.in_file.as_ref().expect("they stand for others");
    let expected = in_file.iter().filter(|&&i| labeled().contains(i)).count();
    assert!(expected > 3);
    assert_eq!(highlighted(&app), expected);
}
