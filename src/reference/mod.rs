//! Axes to compare the method's axis with.
