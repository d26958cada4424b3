//! The tools of the left mouse button.

/// A tool of the left mouse button, which says what a drag in the view does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Tool {
    /// It moves the camera, and a click picks a point.
    #[default]
    Navigate,
    /// It moves the fruit center.
    MoveCenter,
    /// It goes around points that are the peduncle's.
    Lasso,
    /// It paints over points that are the peduncle's.
    Brush,
}
