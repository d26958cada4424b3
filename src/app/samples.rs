//! Clouds that the program brings along; all were simulated by it.

/// A cloud that the program brings along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sample {
    /// A pepper whose axis is found.
    Pepper,
    /// A pepper whose axis is missed.
    MissedPepper,
    /// The paper's ellipsoid (§ 2.1).
    Ellipsoid,
}

impl Sample {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Pepper, Self::MissedPepper, Self::Ellipsoid];

    /// A description in a few words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Pepper => "Pepper whose axis is found",
            Self::MissedPepper => "Pepper whose axis is missed",
            Self::Ellipsoid => "The paper's ellipsoid",
        }
    }

    /// The name that stands in for a path. No such folder is expected to exist.
    pub fn path(self) -> &'static str {
        match self {
            Self::Pepper => "<sample>/pepper.ply",
            Self::MissedPepper => "<sample>/pepper_missed.ply",
            Self::Ellipsoid => "<sample>/ellipsoid.ply",
        }
    }

    /// The bytes of its PLY file.
    pub fn bytes(self) -> &'static [u8] {
        match self {
            Self::Pepper => include_bytes!("../../assets/pepper.ply"),
            Self::MissedPepper => include_bytes!("../../assets/pepper_missed.ply"),
            Self::Ellipsoid => include_bytes!("../../assets/ellipsoid.ply"),
        }
    }

    /// The text of its truth file.
    pub fn truth(self) -> &'static str {
        match self {
            Self::Pepper => include_str!("../../assets/pepper.truth.json"),
            Self::MissedPepper => include_str!("../../assets/pepper_missed.truth.json"),
            Self::Ellipsoid => include_str!("../../assets/ellipsoid.truth.json"),
        }
    }
}
