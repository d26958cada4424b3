//! The paper's Fig. 3, 5, 7, 9, 10 and 11: clouds with their planes and axes, from several sides.

use glam::DVec3;

use super::peppers::filters;
use super::scans::Scan;
use super::{ReproduceError, ReproduceSettings};
use crate::charts::{CloudViews, Dashes, Figure, View, ViewKey};
use crate::geometry::{Cloud, Plane, Unit};
use crate::method::{Analysis, Params, Preset, Side, Stages, Surface, plane_detail};
use crate::peduncle::Peduncle;
use crate::simulate::{EllipsoidSettings, PepperSettings};

/// The depth of the ellipsoid of Fig. 3 and 7 in centimeters.
const FIG_3_DEPTH_CM: f64 = 20.0;
/// The points of a pepper are thinned to this for a picture, in centimeters.
const DRAWN_VOXEL_CM: f64 = 0.3;

// The colors of Okabe and Ito, and what the paper draws in a color of its own.
const GRAY: &str = "#9aa5ad";
const RED: &str = "#D55E00";
const BLUE: &str = "#56B4E9";
const YELLOW: &str = "#E69F00";
const GREEN: &str = "#009E73";
const BLACK: &str = "#000000";

/// A direction to look from, as unit vectors in the camera's frame (x right, y down, z ahead).
#[derive(Debug, Clone, Copy)]
struct Direction {
    right: DVec3,
    up: DVec3,
}

impl Direction {
    const FRONT: Self = Self {
        right: DVec3::X,
        up: DVec3::NEG_Y,
    };
    /// From the image's right.
    const SIDE: Self = Self {
        right: DVec3::Z,
        up: DVec3::NEG_Y,
    };
    const ABOVE: Self = Self {
        right: DVec3::X,
        up: DVec3::Z,
    };

    /// From a direction, with image-up as far up as possible.
    fn from(toward_viewer: DVec3) -> Self {
        let right = DVec3::NEG_Y.cross(toward_viewer).normalize_or(DVec3::X);
        Self {
            right,
            up: toward_viewer.cross(right).normalize_or(DVec3::NEG_Y),
        }
    }

    fn of(self, point: DVec3) -> (f64, f64) {
        (point.dot(self.right), point.dot(self.up))
    }
}

/// Draws points, each with the index of its key, and lines from one side.
fn view(
    name: impl Into<String>,
    direction: Direction,
    points: &[DVec3],
    key: impl Fn(usize) -> usize,
    lines: &[([DVec3; 2], usize)],
) -> View {
    let toward_viewer = direction.right.cross(direction.up);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        points[a]
            .dot(toward_viewer)
            .total_cmp(&points[b].dot(toward_viewer))
    });
    View {
        name: name.into(),
        points: order
            .into_iter()
            .map(|i| (direction.of(points[i]), key(i)))
            .collect(),
        lines: lines
            .iter()
            .map(|&(ends, key)| (ends.map(|end| direction.of(end)), key))
            .collect(),
    }
}

fn dots(name: &str, color: &'static str) -> ViewKey {
    ViewKey {
        name: name.to_owned(),
        color,
        line: None,
    }
}

fn line(name: &str, color: &'static str, dashes: Dashes) -> ViewKey {
    ViewKey {
        name: name.to_owned(),
        color,
        line: Some(dashes),
    }
}

fn views(title: &str, keys: Vec<ViewKey>, columns: usize, views: Vec<View>) -> Figure {
    CloudViews {
        title: title.to_owned(),
        keys,
        columns,
        views,
        unit: "cm",
    }
    .into()
}

/// The ends of an axis through `origin`, long enough to leave the fruit.
fn axis_line(origin: DVec3, direction: DVec3, half_cm: f64) -> [DVec3; 2] {
    [origin - direction * half_cm, origin + direction * half_cm]
}

fn ellipsoid(settings: &ReproduceSettings) -> EllipsoidSettings {
    let defaults = EllipsoidSettings::default();
    EllipsoidSettings {
        center_cm: defaults.center_cm.with_z(FIG_3_DEPTH_CM),
        points: settings.points,
        seed: settings.seed,
        ..defaults
    }
}

/// Fig. 3: the simulated cloud from the front and from the side.
pub(super) fn fig3(settings: &ReproduceSettings) -> Result<Figure, ReproduceError> {
    let cloud = ellipsoid(settings).simulate()?.cloud;
    let from = |name, direction| view(name, direction, cloud.positions(), |_| 0, &[]);
    let sides = vec![
        from("(a) from the front", Direction::FRONT),
        from("(b) from the side", Direction::SIDE),
    ];
    let title = format!("The simulated ellipsoid {FIG_3_DEPTH_CM} cm away (as Fig. 3)");
    Ok(views(&title, vec![dots("points", GRAY)], 2, sides))
}

/// Fig. 5: points with and without a visible partner, with the symmetry plane along the line of sight and turned
/// from it.
pub(super) fn fig5(settings: &ReproduceSettings) -> Result<Figure, ReproduceError> {
    let center = DVec3::new(0.0, 0.0, 40.0);
    let pepper = PepperSettings {
        seed: settings.seed,
        lobes: Some(4),
        asymmetry: 0.0,
        tilt_towards_camera_deg: Some(0.0),
        tilt_sideways_deg: Some(0.0),
        center_cm: Some(center),
        ..PepperSettings::default()
    };
    let keys = vec![
        dots("point with a visible partner", YELLOW),
        dots("on the other side of the plane", RED),
        dots("without a visible partner", GREEN),
        line("plane", BLACK, Dashes::Solid),
    ];
    let mut all = Vec::new();
    for (turned_deg, name) in [(0.0_f64, "(a) frontally"), (45.0, "(b) obliquely")] {
        // The lobes turn with the plane: the same plane of the same fruit.
        let turned = PepperSettings {
            spin_deg: Some(turned_deg),
            ..pepper.clone()
        };
        let cloud = thinned(&turned.simulate()?.cloud);
        let normal = DVec3::new(turned_deg.to_radians().cos(), 0.0, -turned_deg.to_radians().sin());
        let plane = Plane {
            point: center,
            normal,
        };
        let surface = Surface::with_estimated_normals(
            &cloud,
            Params::new(Preset::AsIntended, Unit::Centimeter).k,
            DVec3::ZERO,
            &(),
        )
        .map_err(crate::method::AnalysisError::from)?;
        let detail = plane_detail(&surface, Unit::Centimeter, plane, DVec3::ZERO, &())?;
        let key = |i: usize| match (detail.points[i].partner, detail.points[i].side) {
            (None, _) => 2,
            (Some(_), Side::Front) => 1,
            (Some(_), Side::Back) => 0,
        };
        let within = normal.cross(DVec3::Y);
        let across = [(axis_line(center, within, 8.0), 3)];
        all.push(view(name, Direction::FRONT, surface.points(), key, &[]));
        all.push(view(
            format!("{name}, from above"),
            Direction::ABOVE,
            surface.points(),
            key,
            &across,
        ));
    }
    Ok(views(
        "Points with and without a visible partner (as Fig. 5)",
        keys,
        4,
        all,
    ))
}

/// Fig. 7: the calculated and the real axis of the simulated ellipsoid.
pub(super) fn fig7(settings: &ReproduceSettings) -> Result<Figure, ReproduceError> {
    let settings_of_cloud = ellipsoid(settings);
    let simulated = settings_of_cloud.simulate()?;
    let params = Params {
        u: settings.grid_sizes[settings.main_grid()],
        ..Params::new(Preset::AsIntended, Unit::Centimeter)
    };
    let analysis = Stages::new(simulated.cloud).analyze(&params, &())?;
    let truth = axis_line(simulated.truth.center, simulated.truth.axis.direction, 4.0);
    let camera = Direction::from(-simulated.truth.center.normalize_or(DVec3::Z));
    let close = Direction::from(DVec3::new(0.7, -0.4, -0.6).normalize());
    let pictures = [
        ("(a) from close by", close),
        ("(b) as the camera sees it", camera),
    ];
    let all = pictures.map(|(name, direction)| with_axes(name, direction, &analysis, Some(truth), 4.0));
    Ok(views(
        "Calculated and real axis of the ellipsoid (as Fig. 7)",
        keys_of_axes(Dashes::Solid, true),
        2,
        all.into(),
    ))
}

/// The keys of [`with_axes`].
fn keys_of_axes(calculated: Dashes, with_real: bool) -> Vec<ViewKey> {
    let mut keys = vec![
        dots("one side of the symmetry plane", RED),
        dots("the other side", BLUE),
        line("calculated axis", GREEN, calculated),
    ];
    if with_real {
        keys.push(line("real axis (white in the paper)", BLACK, Dashes::Solid));
    }
    keys
}

/// The sides of an analysis's symmetry plane, its axis and the real one.
fn with_axes(
    name: impl Into<String>,
    direction: Direction,
    analysis: &Analysis,
    real: Option<[DVec3; 2]>,
    half_cm: f64,
) -> View {
    let plane = analysis.best.ok().map(|best| Plane {
        point: analysis.center,
        normal: best.candidate.normal,
    });
    let axis = analysis
        .axis
        .as_ref()
        .map(|axis| (axis_line(axis.origin, axis.direction, half_cm), 2));
    let lines: Vec<_> = real.map(|real| (real, 3)).into_iter().chain(axis).collect();
    sides_of(name, direction, analysis.surface.points(), plane, &lines)
}

fn sides_of(
    name: impl Into<String>,
    direction: Direction,
    points: &[DVec3],
    plane: Option<Plane>,
    lines: &[([DVec3; 2], usize)],
) -> View {
    let key = |i: usize| usize::from(plane.is_some_and(|plane| plane.signed_distance(points[i]) < 0.0));
    view(name, direction, points, key, lines)
}

/// A pepper of § 3.2 in both variants, analyzed as intended.
pub(super) struct SamplePepper {
    /// With the peduncle, then without it; each with the line of § 3.2's reference.
    variants: [(Analysis, [DVec3; 2]); 2],
}

impl SamplePepper {
    /// Scans and analyzes the first pepper of a set, thinned for a picture.
    ///
    /// # Errors
    /// Returns an error if the pepper cannot be simulated or analyzed.
    pub(super) fn new(scan: &Scan, u: usize) -> Result<Self, ReproduceError> {
        let simulated = scan.pepper(scan.seed).simulate()?;
        let peduncle = Peduncle::by_label(&simulated.cloud)?;
        let params = Params {
            u,
            normals: scan.normals(),
            filters: filters(DRAWN_VOXEL_CM),
            ..Params::new(Preset::AsIntended, Unit::Centimeter)
        };
        let analyzed = |cloud: Cloud| -> Result<_, ReproduceError> {
            let analysis = Stages::new(cloud).analyze(&params, &())?;
            let reference = peduncle.reference_axis(analysis.center)?;
            Ok((analysis, axis_line(reference.origin, reference.direction, 9.0)))
        };
        let bare = peduncle.removed_from(&simulated.cloud);
        Ok(Self {
            variants: [analyzed(simulated.cloud)?, analyzed(bare)?],
        })
    }

    /// The variants in the paper's order: (a) without the peduncle, (b) with it.
    fn in_order(&self) -> [(&'static str, &Analysis, [DVec3; 2]); 2] {
        let [with, without] = &self.variants;
        [("(a)", &without.0, without.1), ("(b)", &with.0, with.1)]
    }

    /// Fig. 9: six of the u² candidate planes.
    pub(super) fn fig9(&self) -> Figure {
        let mut all = Vec::new();
        for (letter, analysis, _) in self.in_order() {
            let order = analysis.ranking.order();
            let shown = (0..6).map(|i| i * order.len().saturating_sub(1) / 5);
            for rank in shown.filter(|&rank| rank < order.len()) {
                let candidate = analysis.planes.grid.candidate(order[rank]);
                let plane = Plane {
                    point: analysis.center,
                    normal: candidate.normal,
                };
                let score = analysis.ranking.scores_cm()[order[rank]].unwrap_or_default();
                let name = format!("{letter} rank {}: {score:.2} cm", rank + 1);
                all.push(sides_of(
                    name,
                    Direction::FRONT,
                    analysis.surface.points(),
                    Some(plane),
                    &[],
                ));
            }
        }
        let keys = keys_of_axes(Dashes::Solid, false).into_iter().take(2).collect();
        views(
            "Six candidate planes, the symmetry plane first (as Fig. 9)",
            keys,
            6,
            all,
        )
    }

    /// Fig. 10: the calculated axis from several sides.
    pub(super) fn fig10(&self) -> Figure {
        let all = self.several_sides(false);
        views(
            "The calculated axis of a pepper (as Fig. 10)",
            keys_of_axes(Dashes::Dashed, false),
            3,
            all,
        )
    }

    /// Fig. 11: the calculated axis and the reference of § 3.2 from several sides.
    pub(super) fn fig11(&self) -> Figure {
        let all = self.several_sides(true);
        views(
            "Calculated axis and the peduncle's (as Fig. 11)",
            keys_of_axes(Dashes::Solid, true),
            3,
            all,
        )
    }

    fn several_sides(&self, with_reference: bool) -> Vec<View> {
        let oblique = Direction::from(DVec3::new(0.6, -0.5, -0.6).normalize());
        let directions = [
            ("the front", Direction::FRONT),
            ("the right", Direction::SIDE),
            ("above right", oblique),
        ];
        let variant = |(letter, analysis, reference): (&str, &Analysis, [DVec3; 2])| {
            directions.map(|(side, direction)| {
                let real = with_reference.then_some(reference);
                with_axes(format!("{letter} from {side}"), direction, analysis, real, 9.0)
            })
        };
        self.in_order().into_iter().flat_map(variant).collect()
    }
}

/// A cloud of fewer points, for a picture.
fn thinned(cloud: &Cloud) -> Cloud {
    crate::geometry::voxel_grid(cloud, DRAWN_VOXEL_CM)
}
