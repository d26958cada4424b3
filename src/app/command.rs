//! Everything that can be asked of the program.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use glam::{DVec2, DVec3};

use super::estimators::EstimatorsCommand;
use super::many::commands::ManyCommand;
use super::peduncle::commands::PeduncleCommand;
use super::samples::Sample;
use super::simulator::SimulatorCommand;
use super::state::PlaneChoice;
use super::tool::Tool;
use super::true_axes::commands::TrueAxesCommand;
use crate::evaluate::TruthChoice;
use crate::fruit::Request;
use crate::method::Preset;
use crate::render::{Camera, Projection};
use crate::view::{Style, ViewPreset};

/// Something that a panel asks for. Panels change nothing themselves.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Open files and folders, and show the first of them.
    Open(Vec<PathBuf>),
    /// Open a sample that the program brings along.
    OpenSample(Sample),
    /// Show a cloud of the list.
    Show(usize),
    /// Show the one so many further on.
    Go(isize),
    /// Take the current cloud off the list.
    Close,
    /// Something about the simulated pepper.
    Simulate(SimulatorCommand),
    /// Read the current cloud again.
    Reload,

    /// Analyze as asked. Changes of one gesture are one step of undo.
    Set {
        /// The new settings.
        request: Box<Request>,
        /// The control that is being dragged.
        gesture: Option<&'static str>,
    },
    /// The control that was dragged was let go.
    EndGesture,
    /// Back to a preset's reading of the paper; u, τ, k and the rest stay.
    UsePreset(Preset),
    /// Take back the last change.
    Undo,
    /// Take back the last undo.
    Redo,
    /// Call the analysis off.
    Cancel,
    /// Analyze after a cancellation.
    Resume,
    /// Measure errors against another reference.
    Compare(TruthChoice),

    /// Look at a plane.
    LookAt(PlaneChoice),
    /// Look at the plane so many further on in the grid.
    Step(isize),
    /// Look at the plane so many places further on in the ranking.
    StepRank(isize),
    /// Look at a plane while the cursor is on it.
    Preview(Option<usize>),
    /// Play through all planes, or stop.
    Play(bool),

    /// Draw otherwise.
    Style(Box<Style>),
    /// Gray the points whose contribution is outside.
    Brush(Option<RangeInclusive<f64>>),
    /// Pick the point at a place of the view, in logical pixels.
    PickAt(DVec2),
    /// Tell which point is under the cursor.
    PointAt(Option<DVec2>),
    /// Pick a point by its index among the shown ones, or none.
    Pick(Option<usize>),

    /// See from elsewhere.
    Camera(Box<Camera>),
    /// See from one of the usual places.
    View(ViewPreset),
    /// Show everything, from the same direction.
    Frame,
    /// Turn about the picked point, or about the fruit center.
    PivotOnPicked,
    /// Change the projection.
    Project(Projection),
    /// Take a tool.
    Use(Tool),
    /// Take the eye of the view as the viewpoint `p_v` of the method.
    LookFromHere,
    /// Make a cloud of the points that a depth camera in the place of the eye would see.
    ScanFromHere,
    /// Write the current cloud, which lies in no file, to a PLY file; its truth beside it where there is one.
    SaveCloud(PathBuf),
    /// Put the fruit center somewhere, in the file's unit and frame.
    MoveCenter(DVec3),
    /// Something about the estimates of the axis.
    Estimators(EstimatorsCommand),
    /// Pick the peduncle.
    Peduncle(PeduncleCommand),

    /// Something of the set of open clouds.
    Many(ManyCommand),

    /// Something about axes set by hand.
    TrueAxes(TrueAxesCommand),

    /// Make the interface larger or smaller.
    Scale(f32),
    /// Forget a message.
    Dismiss(u64),
    /// Say something.
    Say {
        /// Whether something failed.
        is_error: bool,
        /// The message, in a sentence.
        text: String,
    },
    /// Save the view as a PNG.
    SaveImage {
        /// The file.
        path: PathBuf,
        /// Width and height in pixels.
        size_px: [u32; 2],
    },
}
