//! Fruits of other kinds before a depth camera: pears, eggplants, cucumbers, tomatoes, apples, and balls.

mod bend;
mod kind;
mod settings;

use rand::{Rng, RngExt};

use self::bend::Bend;
use super::error::within;
use super::random::{Stream, set_or_draw, stream};
use super::shape::{Asymmetry, Body, Form, Paint};
use super::surroundings::Reach;
use super::{Settings, SimulateError, Simulated, Truth};

pub use self::kind::FruitKind;
pub use self::settings::FruitSettings;

impl FruitSettings {
    /// Draws the settings that are open, builds the fruit, and measures it by the camera, as
    /// [`PepperSettings::simulate`](super::PepperSettings::simulate) does.
    ///
    /// The streams and the order of their draws are part of the format: another order gives another fruit for
    /// the same seed.
    ///
    /// # Errors
    /// Returns an error if a setting is out of range, or the camera sees nothing of the fruit.
    pub fn simulate(&self) -> Result<Simulated, SimulateError> {
        self.check()?;
        let measures = self.kind.measures();
        let mut drawn = self.clone();
        let mut shape = stream(self.seed, Stream::Shape);
        let body = drawn.draw_body(&mut shape)?;
        let length_cm = body.half_height_cm * 2.0;
        let bend = Bend::new(self.bend_deg, length_cm);
        let thickest = bend.map_or(f64::INFINITY, |bend| 1.6 * bend.radius_cm());
        let allowed = "at most 1.6 of the radius that the fruit is bent by";
        within("width_cm", body.half_width_cm * 2.0, (0.0, thickest), allowed)?;

        let has_peduncle = self.kind != FruitKind::Ball || self.surroundings.peduncle_length_cm.is_some();
        let ranges = [measures.peduncle_length_cm, measures.peduncle_width_cm];
        let peduncle = drawn
            .surroundings
            .draw_peduncle(body.calyx_cm(), ranges, &mut shape);
        let reach = Reach {
            ball_cm: body.ball_cm() + bend.map_or(0.0, |bend| bend.sagitta_cm()),
            margin: 1.0 + 2.0 * drawn.asymmetry.unwrap_or(0.0),
        };
        let placement = drawn.surroundings.place(self.seed, reach, &peduncle)?;
        let mut colors = stream(self.seed, Stream::Color);
        let drawn_color = measures.colors[colors.random_range(0..measures.colors.len())];
        let color = self.color.unwrap_or(drawn_color);
        drawn.color = Some(color);
        let paint = Paint::draw(color, &mut colors);

        let mut mesh = body.mesh(&paint);
        if has_peduncle {
            mesh.append(&peduncle.mesh(&paint));
        } else {
            drawn.surroundings.peduncle_length_cm = None;
        }
        if let Some(bend) = bend {
            mesh = mesh.deformed(|p| bend.bent(p));
        }
        let mesh = mesh.moved(placement.camera_from_fruit, placement.center_cm);
        let half_length_cm = bend.map_or(body.half_height_cm, |bend| bend.half_chord_cm());
        let is_exact = drawn.asymmetry == Some(0.0) && body.lobe_depth == 0.0 && bend.is_none();
        let note = drawn.note(is_exact).map(Into::into);
        let surroundings = drawn.surroundings.clone();
        let truth = placement.truth(half_length_cm, self.seed, Settings::Fruit(Box::new(drawn)));
        let axis = truth.axis.direction;
        let truth = Truth {
            revolution_axis: (is_exact && self.kind != FruitKind::Ball).then_some(axis),
            note,
            ..truth
        };
        surroundings.measure(mesh, &paint, truth)
    }

    /// A caveat about errors against the axis.
    fn note(&self, is_exact: bool) -> Option<&'static str> {
        if self.kind == FruitKind::Ball {
            return Some(
                "A ball: every line through the center is an axis. The one given is the fruit's y axis by \
                 convention only.",
            );
        }
        if self.bend_deg > 0.0 {
            return Some("The fruit is bent: the axis given runs from end to end.");
        }
        (!is_exact).then_some(
            "The axis is the one the fruit was built around; the fruit departs from it slightly, as real ones \
             do (see asymmetry and rib_depth).",
        )
    }

    /// Draws the body's open settings and keeps them.
    fn draw_body(&mut self, rng: &mut impl Rng) -> Result<Body, SimulateError> {
        let m = self.kind.measures();
        let mut draw = |set: &mut Option<f64>, (low, high): (f64, f64), scale: f64| {
            let value = set_or_draw(*set, rng, low * scale, high * scale);
            *set = Some(value);
            value
        };
        let length_cm = draw(&mut self.length_cm, m.length_cm, 1.0);
        let width_cm = draw(&mut self.width_cm, m.width, length_cm);
        let taper = draw(&mut self.taper, m.taper, 1.0);
        let neck = draw(&mut self.neck, m.neck, 1.0);
        let dent_cm = draw(&mut self.dent_cm, m.dent, length_cm);
        let deepest = (0.0, length_cm / 4.0);
        within("dent_cm", dent_cm, deepest, "0 to a quarter of length_cm")?;
        let rib_depth = draw(&mut self.rib_depth, m.rib_depth, 1.0);
        let asymmetry = draw(&mut self.asymmetry, m.asymmetry, 1.0);
        let drawn_ribs = rng.random_range(m.ribs.0..=m.ribs.1);
        let ribs = *self.ribs.get_or_insert(drawn_ribs);
        Ok(Body {
            form: Form { neck, ..m.form },
            half_height_cm: length_cm / 2.0,
            half_width_cm: width_cm / 2.0,
            lobes: ribs,
            lobe_depth: rib_depth,
            taper,
            dimple_cm: dent_cm,
            asymmetry: Asymmetry::draw(asymmetry, &mut stream(self.seed, Stream::Asymmetry)),
        })
    }
}
