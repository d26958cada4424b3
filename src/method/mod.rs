//! The paper, a file a step.
