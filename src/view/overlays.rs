//! The overlays of a view, each with a switch.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::str::FromStr;

/// One thing that can be drawn over the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Overlay {
    /// The candidate plane, its outline, and the points that it cuts through.
    Plane,
    /// The plane's normal.
    Normal,
    /// The fruit center p_c.
    Center,
    /// The viewpoint p_v and the ray from there.
    Viewpoint,
    /// The computed axis.
    Axis,
    /// The reference axis.
    Reference,
    /// All references, if there are several.
    References,
    /// The cloud mirrored in the plane.
    Ghost,
    /// Lines from a sample of points to their partners.
    Partners,
    /// The normals of a sample of points.
    Normals,
    /// The legend of the colors.
    Legend,
    /// A scale bar.
    Scale,
    /// The directions of x, y and z.
    Triad,
    /// The caption.
    Caption,
}

impl Overlay {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Plane,
        Self::Normal,
        Self::Center,
        Self::Viewpoint,
        Self::Axis,
        Self::Reference,
        Self::References,
        Self::Ghost,
        Self::Partners,
        Self::Normals,
        Self::Legend,
        Self::Scale,
        Self::Triad,
        Self::Caption,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Normal => "normal",
            Self::Center => "center",
            Self::Viewpoint => "viewpoint",
            Self::Axis => "axis",
            Self::Reference => "reference",
            Self::References => "references",
            Self::Ghost => "ghost",
            Self::Partners => "partners",
            Self::Normals => "normals",
            Self::Legend => "legend",
            Self::Scale => "scale",
            Self::Triad => "triad",
            Self::Caption => "caption",
        }
    }
}

/// The set of overlays that are on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Overlays(BTreeSet<Overlay>);

impl Default for Overlays {
    /// The plane, both axes and everything that explains the picture.
    fn default() -> Self {
        use Overlay::{Axis, Caption, Center, Legend, Plane, Reference, Scale, Triad};
        Self([Plane, Center, Axis, Reference, Legend, Scale, Triad, Caption].into())
    }
}

impl Overlays {
    /// None.
    pub fn none() -> Self {
        Self(BTreeSet::new())
    }

    /// All of them.
    pub fn all() -> Self {
        Self(Overlay::ALL.into())
    }

    /// Whether it is on.
    pub fn has(&self, overlay: Overlay) -> bool {
        self.0.contains(&overlay)
    }

    /// Turns one on or off.
    pub fn set(&mut self, overlay: Overlay, on: bool) {
        if on {
            self.0.insert(overlay);
        } else {
            self.0.remove(&overlay);
        }
    }
}

impl FromStr for Overlays {
    type Err = String;

    /// Names with commas between them, or `all`, or `none`.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "all" => return Ok(Self::all()),
            "none" => return Ok(Self::none()),
            _ => {}
        }
        let one = |name: &str| {
            let found = Overlay::ALL.into_iter().find(|o| o.name() == name);
            found.ok_or_else(|| {
                let names = Overlay::ALL.map(Overlay::name).join(", ");
                format!("there is no overlay “{name}”; there are {names}, or all or none")
            })
        };
        text.split(',')
            .map(|name| one(name.trim()))
            .collect::<Result<_, _>>()
            .map(Self)
    }
}
