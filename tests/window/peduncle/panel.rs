//! The panel of the peduncle, and dropped files.

use super::*;

/// A file as the desktop drops it.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("files are opened by their paths".into())
    }
}

/// The parameters' panel with the peduncle's section open and everything above it closed.
fn open_section(harness: &mut Windowed) {
    click(harness, "Peduncle");
    let section = harness.get_by_label("Peduncle");
    section.scroll_to_me();
    settle(harness);
}
#[test]
fn a_dropped_companion_is_offered_as_the_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1100.0, 720.0], vec![pepper(&folder, true)]);
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let indices: Vec<usize> = labeled().iter().collect();
    let dropped = write_cloud(&cloud.select(&indices), &folder.path().join("x_peduncle.ply"));
    harness.input_mut().dropped_files = vec![Arc::new(Dropped(dropped.clone()))];
    settle(&mut harness);
    assert_eq!(state(&harness).entries.len(), 1, "it is no cloud of the list");
    snapshot(&mut harness, "offered");
    click(&mut harness, "Use as its peduncle");
    let fruit = &state(&harness).walked.as_ref().expect("analyzed").fruit;
    let found = fruit.peduncle.as_ref().expect("found");
    assert_eq!(
        (found.source, found.points),
        (PeduncleSource::Companion, labeled().len())
    );
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(state(&harness).settings.request.peduncle, PeduncleChoice::Auto);
}

#[test]
fn a_companion_that_is_dropped_with_its_cloud_is_its_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let cloud = pepper(&folder, true);
    let full = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let indices: Vec<usize> = labeled().iter().collect();
    let companion = write_cloud(&full.select(&indices), &folder.path().join("fruit_peduncle.ply"));
    let mut harness = window([1000.0, 700.0], Vec::new());
    let files = [companion, cloud];
    harness.input_mut().dropped_files = files.map(|path| Arc::new(Dropped(path)) as _).to_vec();
    settle(&mut harness);
    assert_eq!(state(&harness).entries.len(), 1, "one cloud");
    let fruit = &state(&harness).walked.as_ref().expect("analyzed").fruit;
    let found = fruit.peduncle.as_ref().expect("found");
    assert_eq!(
        (found.source, found.points),
        (PeduncleSource::Companion, labeled().len())
    );
}

#[test]
fn the_panel_says_what_to_do_where_there_is_no_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1360.0, 1100.0], vec![pepper(&folder, false)]);
    open_section(&mut harness);
    harness.get_by_label_contains("This cloud has no peduncle yet");
    harness.get_by_label("Pick with the lasso").click();
    settle(&mut harness);
    assert_eq!(state(&harness).tool, Tool::Lasso);
    compare_left(&mut harness, FOLDER, "none_yet");
}

#[test]
fn hues_are_chosen_on_their_histogram_and_shown_in_the_view() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1360.0, 1100.0], vec![pepper(&folder, true)]);
    let range = HueRange {
        from_deg: 60.0,
        to_deg: 160.0,
    };
    apply(
        &mut harness,
        Command::Peduncle(PeduncleCommand::Choose(PeduncleChoice::Hue(range))),
    );
    open_section(&mut harness);
    let bar = harness.get_by_label_contains("Hues of the cloud").rect();
    let at = |deg: f32| Pos2::new(bar.left() + bar.width() * deg / 360.0, bar.center().y);
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &[at(60.0), at(90.0)],
        |harness| {
            settle(harness);
            assert!(state(harness).peduncle.is_previewed);
            assert!(state(harness).peduncle.marked.as_ref().expect("it shows").points > 0);
            compare_left(harness, FOLDER, "hues");
        },
    );
    let PeduncleChoice::Hue(range) = state(&harness).settings.request.peduncle else {
        panic!("a range of hues");
    };
    assert!(
        (range.from_deg - 90.0).abs() <= 1.0 && range.to_deg == 160.0,
        "{range:?}"
    );
    harness.remove_cursor();
    settle(&mut harness);
    assert!(
        state(&harness).peduncle.marked.is_none(),
        "the highlight goes with the cursor"
    );
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        state(&harness).settings.request.peduncle,
        PeduncleChoice::Hue(HueRange {
            from_deg: 60.0,
            to_deg: 160.0
        }),
        "one drag, one step"
    );
}

#[test]
fn both_references_and_both_experiments_stand_in_the_panel() {
    let mut harness = window([1360.0, 1100.0], Vec::new());
    open_section(&mut harness);
    click(&mut harness, "Compare with and without");
    assert!(state(&harness).peduncle.beside.is_some());
    let mut style = state(&harness).style.clone();
    style.overlays.set(Overlay::References, true);
    apply(&mut harness, Command::Style(Box::new(style)));
    harness.get_by_label_contains("° apart");
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "references");
}

#[test]
fn what_does_not_fit_is_told_in_the_panel() {
    let mut harness = window([1360.0, 1100.0], Vec::new());
    apply(
        &mut harness,
        Command::Peduncle(PeduncleCommand::Choose(PeduncleChoice::Removed(
            "clouds/without".into(),
        ))),
    );
    open_section(&mut harness);
    assert!(state(&harness).analysis().is_some(), "the cloud stays");
    harness.get_by_label("Folder of the clouds without their peduncles");
    harness.remove_cursor();
    settle(&mut harness);
    compare_left(&mut harness, "screenshots/peduncle", "removed_missing");
}
