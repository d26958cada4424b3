//! A sweet pepper before a depth camera.

mod settings;

use rand::{Rng, RngExt};

use super::error::within;
use super::random::{Stream, set_or_draw, stream};
use super::shape::{Asymmetry, Body, Form, Paint, Peduncle};
use super::surroundings::{Placement, Reach};
use super::{FruitColor, Settings, SimulateError, Simulated, Truth};

pub use self::settings::PepperSettings;

/// A pepper with nothing left to chance.
struct Drawn {
    /// The settings, every one of which is set.
    settings: PepperSettings,
    body: Body,
    peduncle: Peduncle,
    placement: Placement,
    paint: Paint,
}

impl PepperSettings {
    /// The same settings with everything drawn that was open.
    ///
    /// # Errors
    /// Returns an error if a setting is out of range.
    pub fn drawn(&self) -> Result<Self, SimulateError> {
        Ok(self.draw()?.settings)
    }

    /// Draws the settings that are open, builds the fruit, and measures it by the camera.
    ///
    /// The cloud is in centimeters in the camera's frame, with colors and the labels of [`Cloud`]. Of one view it has a
    /// point for each pixel that measured one, row by row, and no normals, which a camera does not measure. Of
    /// several it has a point for each occupied voxel, with normals turned towards the cameras that saw it, in the frame
    /// of the middle view. A leaf keeps its place between the middle view and the fruit; in each view it is cropped to
    /// the rectangle of the image that the fruit takes up, as a detector's box would.
    ///
    /// [`Cloud`]: crate::geometry::Cloud
    ///
    /// # Errors
    /// Returns an error if a setting is out of range, or the camera sees nothing of the fruit.
    pub fn simulate(&self) -> Result<Simulated, SimulateError> {
        let drawn = self.draw()?;
        let (body, placement) = (&drawn.body, drawn.placement);
        let mut mesh = body.mesh(&drawn.paint);
        mesh.append(&drawn.peduncle.mesh(&drawn.paint));
        let mesh = mesh.moved(placement.camera_from_fruit, placement.center_cm);
        let surroundings = drawn.settings.surroundings();
        let settings = Settings::Pepper(Box::new(drawn.settings));
        let note = (self.asymmetry > 0.0).then(|| {
            "The axis is the one the fruit was built around; the fruit departs from it \
             slightly, as real ones do (see asymmetry)."
                .into()
        });
        let truth = Truth {
            note,
            ..placement.truth(body.half_height_cm, self.seed, settings)
        };
        surroundings.measure(mesh, &drawn.paint, truth)
    }

    /// Draws everything that is not set. The streams and the order of their draws are part of the format: another order
    /// gives another pepper for the same seed.
    fn draw(&self) -> Result<Drawn, SimulateError> {
        self.check()?;
        let mut surroundings = self.surroundings();
        let mut shape = stream(self.seed, Stream::Shape);
        let body = self.draw_body(&mut shape)?;
        let ranges = [(3.5, 5.0), (0.7, 0.95)];
        let peduncle = surroundings.draw_peduncle(body.calyx_cm(), ranges, &mut shape);
        let reach = Reach {
            ball_cm: body.ball_cm(),
            margin: 1.0 + 2.0 * self.asymmetry,
        };
        let placement = surroundings.place(self.seed, reach, &peduncle)?;
        let mut colors = stream(self.seed, Stream::Color);
        let drawn_color = FruitColor::PEPPERS[colors.random_range(0..FruitColor::PEPPERS.len())];
        let color = self.color.unwrap_or(drawn_color);
        let settings = Self {
            height_cm: Some(body.half_height_cm * 2.0),
            width_cm: Some(body.half_width_cm * 2.0),
            lobes: Some(body.lobes),
            lobe_depth: Some(body.lobe_depth),
            taper: Some(body.taper),
            dimple_cm: Some(body.dimple_cm),
            color: Some(color),
            ..self.clone()
        };
        Ok(Drawn {
            settings: settings.with_surroundings(surroundings),
            body,
            peduncle,
            placement,
            paint: Paint::draw(color, &mut colors),
        })
    }

    fn draw_body(&self, rng: &mut impl Rng) -> Result<Body, SimulateError> {
        let height_cm = set_or_draw(self.height_cm, rng, 7.0, 11.0);
        let width_cm = set_or_draw(self.width_cm, rng, 0.75 * height_cm, 0.95 * height_cm);
        let drawn_lobes = rng.random_range(3..=4);
        let lobe_depth = set_or_draw(self.lobe_depth, rng, 0.08, 0.16);
        let taper = set_or_draw(self.taper, rng, 0.1, 0.35);
        let dimple_cm = set_or_draw(self.dimple_cm, rng, 0.1 * height_cm, 0.15 * height_cm);
        let deepest = (0.0, height_cm / 4.0);
        within("dimple_cm", dimple_cm, deepest, "0 to a quarter of height_cm")?;
        let mut irregular = stream(self.seed, Stream::Asymmetry);
        Ok(Body {
            form: Form::PEPPER,
            half_height_cm: height_cm / 2.0,
            half_width_cm: width_cm / 2.0,
            lobes: self.lobes.unwrap_or(drawn_lobes),
            lobe_depth,
            taper,
            dimple_cm,
            asymmetry: Asymmetry::draw(self.asymmetry, &mut irregular),
        })
    }
}
