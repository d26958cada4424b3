//! The frames of the README's animation, drawn by the window itself: `scripts/animation` makes a GIF of them.
//!
//! Each frame is a PNG whose name ends with how long it is shown, in hundredths of a second.

use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::Context;
use axiscope::app::{Command, PlaneChoice, Session};
use axiscope::ui::{Start, Window};
use axiscope::view::Coloring;
use egui::{Vec2, vec2};
use egui_kittest::Harness;

const SIZE: Vec2 = vec2(960.0, 600.0);

struct Film {
    harness: Harness<'static, Window>,
    folder: PathBuf,
    frames: usize,
}

impl Film {
    fn new(folder: &Path) -> anyhow::Result<Self> {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        let start = Start {
            session: Session::first(),
            session_path: None,
            paths: Vec::new(),
            problem: None,
        };
        let harness = Harness::builder()
            .with_size(SIZE)
            .with_max_steps(64)
            .wgpu()
            .build_eframe(move |context| Window::new(context, start).expect("threads can be started"));
        Ok(Self {
            harness,
            folder: folder.to_path_buf(),
            frames: 0,
        })
    }

    fn apply(&mut self, command: Command) {
        self.harness.state_mut().app_mut().apply(command);
        self.settle();
    }

    fn settle(&mut self) {
        // Four calm frames: the last of them shows everything.
        let mut calm = 0;
        while calm < 4 {
            self.harness.step();
            calm = if self.harness.state().app().is_busy() {
                0
            } else {
                calm + 1
            };
        }
    }

    /// Draws what the window shows now; it stays for that long.
    fn hold(&mut self, time: Duration) -> anyhow::Result<()> {
        let picture = self.harness.render().map_err(anyhow::Error::msg)?;
        let hundredths = time.as_millis() / 10;
        let name = format!("{:03}_{hundredths:03}.png", self.frames);
        picture.save(self.folder.join(name))?;
        self.frames += 1;
        Ok(())
    }

    fn color(&mut self, coloring: Coloring) {
        let mut style = self.harness.state().app().state().style.clone();
        style.coloring = coloring;
        self.apply(Command::Style(Box::new(style)));
    }

    fn set_u(&mut self, u: usize) {
        let mut request = self.harness.state().app().state().settings.request.clone();
        request.params.u = u;
        let request = Box::new(request);
        self.apply(Command::Set {
            request,
            gesture: None,
        });
    }

    /// Moves the camera around the cloud.
    fn turn(&mut self, angle_rad: f64) {
        let mut camera = self.harness.state().app().state().camera;
        camera.orbit(angle_rad, 0.0);
        self.apply(Command::Camera(Box::new(camera)));
    }
}

fn main() -> anyhow::Result<()> {
    let folder = std::env::args_os()
        .nth(1)
        .context("the folder of the frames is not named")?;
    let mut film = Film::new(Path::new(&folder))?;
    film.settle();
    let millis = Duration::from_millis;

    // All candidate planes that have a score, from the worst to the best.
    film.apply(Command::StepRank(10_000));
    film.hold(millis(1200))?;
    let ranked = film
        .harness
        .state()
        .app()
        .state()
        .analysis()
        .map_or(0, |a| a.ranking.order().len());
    for _ in 1..ranked {
        film.apply(Command::StepRank(-1));
        film.hold(millis(360))?;
    }
    film.apply(Command::LookAt(PlaneChoice::Best));
    film.hold(millis(2200))?;
    // Where the score comes from.
    film.color(Coloring::Score);
    film.hold(millis(1600))?;
    // A finer grid.
    film.set_u(12);
    film.hold(millis(2200))?;
    film.color(Coloring::Side);
    // Once to the side and back: the axes are apart in depth, too.
    let steps = 12;
    for step in 0..2 * steps {
        let direction = if step < steps { 1.0 } else { -1.0 };
        film.turn(direction * 4.0_f64.to_radians());
        film.hold(millis(100))?;
    }
    film.hold(millis(1500))
}
