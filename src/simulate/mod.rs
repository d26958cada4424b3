//! Clouds whose axis is known: the paper's ellipsoid, a pepper, and the depth camera that looks at them.
