//! The meaning of each property of a vertex.

use super::Note;
use super::error::{PlyError, Problem};
use super::header::{Element, Kind};
use super::scalar::Scalar;

/// The role of a vertex's property in a cloud. The discriminants index the columns of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    X,
    Y,
    Z,
    NormalX,
    NormalY,
    NormalZ,
    Red,
    Green,
    Blue,
    Alpha,
    Label,
}

impl Role {
    /// The number of roles.
    pub(super) const COUNT: usize = Self::Label as usize + 1;
    /// The position, one role per axis.
    pub(super) const POSITION: [Self; 3] = [Self::X, Self::Y, Self::Z];
    /// The normal, one role per axis.
    pub(super) const NORMAL: [Self; 3] = [Self::NormalX, Self::NormalY, Self::NormalZ];
    /// The color without its alpha.
    pub(super) const COLOR: [Self; 3] = [Self::Red, Self::Green, Self::Blue];
}

/// Names under which the three properties of a column go.
struct Family {
    names: [&'static str; 3],
    alpha: Option<&'static str>,
    /// The number of present names from which on a note tells of the missing ones: a lone `r` is likely a radius.
    telling: usize,
}

const NORMALS: [Family; 2] = [
    Family {
        names: ["nx", "ny", "nz"],
        alpha: None,
        telling: 1,
    },
    Family {
        names: ["normal_x", "normal_y", "normal_z"],
        alpha: None,
        telling: 1,
    },
];

const COLORS: [Family; 3] = [
    Family {
        names: ["red", "green", "blue"],
        alpha: Some("alpha"),
        telling: 1,
    },
    Family {
        names: ["diffuse_red", "diffuse_green", "diffuse_blue"],
        alpha: Some("diffuse_alpha"),
        telling: 1,
    },
    Family {
        names: ["r", "g", "b"],
        alpha: Some("a"),
        telling: 2,
    },
];

/// In the order of preference; case is of no matter, as some write `scalar_Label`.
const LABELS: [&str; 6] = [
    "label",
    "class",
    "classification",
    "scalar_label",
    "scalar_class",
    "scalar_classification",
];

/// The roles of a vertex element's properties.
#[derive(Debug)]
pub(super) struct Columns {
    /// For each property its role, if it has one.
    roles: Vec<Option<Role>>,
    /// For each role the type of its property, if there is one.
    kinds: [Option<Scalar>; Role::COUNT],
}

impl Columns {
    /// Finds the roles by the properties' names.
    pub(super) fn of(vertex: &Element, notes: &mut Vec<Note>) -> Result<Self, PlyError> {
        let mut columns = Self {
            roles: vec![None; vertex.properties.len()],
            kinds: [None; Role::COUNT],
        };
        for (name, role) in ["x", "y", "z"].into_iter().zip(Role::POSITION) {
            match find(vertex, name) {
                Some((at, Kind::Scalar(kind))) => columns.assign(at, kind, role),
                Some((_, Kind::List { .. })) => {
                    return Err(PlyError::at_line(vertex.line, Problem::CoordinateIsList(name)));
                }
                None => return Err(PlyError::at_line(vertex.line, Problem::NoCoordinate(name))),
            }
        }
        columns.take_family(vertex, &NORMALS, Role::NORMAL, "normals", notes);
        columns.take_family(vertex, &COLORS, Role::COLOR, "colors", notes);
        if let Some((at, kind)) = LABELS.iter().find_map(|name| find_scalar(vertex, name)) {
            columns.assign(at, kind, Role::Label);
        }
        Ok(columns)
    }

    /// The role of each property, in their order.
    pub(super) fn roles(&self) -> &[Option<Role>] {
        &self.roles
    }

    /// The type of the property that has a role, if one has.
    pub(super) fn kind(&self, role: Role) -> Option<Scalar> {
        self.kinds.get(role as usize).copied().flatten()
    }

    fn assign(&mut self, at: usize, kind: Scalar, role: Role) {
        if let (Some(slot), Some(known)) = (self.roles.get_mut(at), self.kinds.get_mut(role as usize)) {
            *slot = Some(role);
            *known = Some(kind);
        }
    }

    fn take_family(
        &mut self,
        vertex: &Element,
        families: &[Family],
        roles: [Role; 3],
        column: &'static str,
        notes: &mut Vec<Note>,
    ) {
        let mut incomplete = None;
        for family in families {
            let found = family.names.map(|name| find_scalar(vertex, name));
            if let [Some(a), Some(b), Some(c)] = found {
                for ((at, kind), role) in [a, b, c].into_iter().zip(roles) {
                    self.assign(at, kind, role);
                }
                if let Some((at, kind)) = family.alpha.and_then(|name| find_scalar(vertex, name)) {
                    self.assign(at, kind, Role::Alpha);
                }
                return;
            }
            let missing = family
                .names
                .into_iter()
                .zip(found)
                .find(|(_, found)| found.is_none());
            if let Some((missing, _)) = missing
                && found.iter().flatten().count() >= family.telling
            {
                incomplete.get_or_insert(Note::Incomplete { column, missing });
            }
        }
        notes.extend(incomplete);
    }
}

/// The property of a name: exactly, or else in any case.
fn find(vertex: &Element, name: &str) -> Option<(usize, Kind)> {
    let properties = || vertex.properties.iter().enumerate();
    properties()
        .find(|(_, property)| property.name == name)
        .or_else(|| properties().find(|(_, property)| property.name.eq_ignore_ascii_case(name)))
        .map(|(at, property)| (at, property.kind))
}

fn find_scalar(vertex: &Element, name: &str) -> Option<(usize, Scalar)> {
    match find(vertex, name)? {
        (at, Kind::Scalar(kind)) => Some((at, kind)),
        (_, Kind::List { .. }) => None,
    }
}
