//! Hues, folders, dropped files; both references and both experiments.

use super::*;

#[test]
fn a_range_of_hues_is_previewed_and_an_empty_one_is_told() {
    let mut app = with_sample();
    let mut request = app.state().settings.request.clone();
    let cloud = fruit(&app).cloud().clone();
    let range = HueRange {
        from_deg: 70.0,
        to_deg: 160.0,
    };
    request.peduncle = PeduncleChoice::Hue(range);
    set(&mut app, |now| *now = request.clone());
    let hues = app.state().peduncle.hues.clone().expect("counted");
    assert_eq!(hues.counts.iter().sum::<usize>() + hues.gray, cloud.len());
    assert_eq!(highlighted(&app), 0, "nobody asked for it");
    ask(&mut app, PeduncleCommand::Preview(true));
    let expected = Peduncle::by_hue(&cloud, range).expect("some are green").points;
    assert_eq!(highlighted(&app), expected);
    assert_eq!(
        app.state().peduncle.marked.as_ref().expect("marked").points,
        expected
    );
    request.peduncle = PeduncleChoice::Hue(HueRange {
        from_deg: 280.0,
        to_deg: 281.0,
    });
    set(&mut app, |now| *now = request);
    assert_eq!(highlighted(&app), 0);
    let walked = app.state().walked.as_ref().expect("the cloud is still there");
    let problem = walked.fruit.peduncle_problem.as_ref().expect("it is told");
    assert!(problem.contains("280"), "{problem}");
    assert!(app.state().look.is_some() && app.state().entries[0].problem.is_none());
    ask(&mut app, PeduncleCommand::Preview(false));
    assert!(app.state().peduncle.marked.is_none());
}

#[test]
fn a_folder_without_peduncles_tells_what_it_lacks_and_what_does_not_fit() {
    let folder = TempDir::new().expect("a folder");
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let full = write_cloud(
        &Cloud::new(cloud.positions().to_vec()),
        &folder.path().join("a.ply"),
    );
    let removed = folder.path().join("removed");
    std::fs::create_dir(&removed).expect("made");
    let body: Vec<usize> = (0..cloud.len()).filter(|&i| !labeled().contains(i)).collect();
    write_cloud(&cloud.select(&body), &removed.join("a.ply"));
    let mut app = open(&full);
    ask(
        &mut app,
        PeduncleCommand::Choose(PeduncleChoice::Removed(removed.clone())),
    );
    let now = fruit(&app).clone();
    let found = now.peduncle.as_ref().expect("found");
    assert_eq!(
        (found.source, found.points),
        (PeduncleSource::Removal, labeled().len())
    );
    // Another fruit under the same name.
    std::fs::copy(asset("ellipsoid.ply"), removed.join("a.ply")).expect("copied");
    act(&mut app, Command::Reload);
    let now = fruit(&app).clone();
    assert!(now.peduncle.is_none());
    let problem = now.peduncle_problem.as_ref().expect("told");
    assert!(problem.contains("not the same cloud"), "{problem}");
    ask(
        &mut app,
        PeduncleCommand::Choose(PeduncleChoice::File("no/such.ply".into())),
    );
    let now = fruit(&app).clone();
    assert!(
        now.peduncle_problem
            .as_ref()
            .expect("told")
            .contains("no/such.ply")
    );
}

#[test]
fn a_dropped_companion_is_offered() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    let dropped = folder.path().join("other_peduncle.ply");
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    write_cloud(&cloud.select(&labeled().iter().collect::<Vec<_>>()), &dropped);
    ask(&mut app, PeduncleCommand::Offer(dropped.clone()));
    assert_eq!(
        app.state().peduncle.question,
        Some(Question::Offer(dropped.clone()))
    );
    assert_eq!(app.state().entries.len(), 1);
    ask(&mut app, PeduncleCommand::Choose(PeduncleChoice::File(dropped)));
    assert_eq!(app.state().peduncle.question, None);
    let fruit = fruit(&app);
    assert_eq!(fruit.peduncle.as_ref().map(|p| p.points), Some(labeled().len()));
}

#[test]
fn with_and_without_the_peduncle_stand_side_by_side() {
    let mut app = with_sample();
    ask(&mut app, PeduncleCommand::Compare(true));
    let beside = app.state().peduncle.beside.clone().expect("computed");
    for (without_peduncle, errors) in [(false, beside.with), (true, beside.without)] {
        let mut request = app.state().settings.request.clone();
        request.without_peduncle = without_peduncle;
        set(&mut app, |now| *now = request);
        let state = app.state();
        let axis = state.analysis().and_then(|a| a.axis.clone()).expect("an axis");
        let expected: Vec<_> = state
            .references
            .iter()
            .map(|r| (r.source.clone(), axis_error_rad(&axis, r).to_degrees()))
            .collect();
        assert_eq!(expected.len(), 3);
        assert_eq!(errors, Ok(expected));
        assert!(state.peduncle.beside.is_some(), "it is of either");
    }
    let mut request = app.state().settings.request.clone();
    request.params.u = 9;
    set(&mut app, |now| *now = request);
    assert!(app.state().peduncle.beside.is_some(), "computed again by itself");
    ask(&mut app, PeduncleCommand::Compare(false));
    assert!(app.state().peduncle.beside.is_none());
}

#[test]
fn errors_are_measured_against_the_peduncle_s_own_direction_where_that_is_asked_for() {
    let mut app = with_sample();
    act(&mut app, Command::Compare(TruthChoice::PeduncleDirection));
    let source = |app: &App| app.state().reference().map(|r| r.source.clone());
    assert_eq!(source(&app), Some(AxisSource::PeduncleDirection));
    let look = app.state().look.as_ref().expect("drawn");
    assert_eq!(look.reference.as_ref().map(|r| r.source.clone()), source(&app));
    let words = command_line(app.state(), "a.png", [9, 9]);
    assert!(
        words
            .windows(2)
            .any(|w| w == ["--reference", "peduncle-direction"])
    );
}
