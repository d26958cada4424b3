//! The author of an axis, and the names of the author's files.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// The role in which an axis is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// An annotator, whose axis is one opinion among several.
    Annotator,
    /// The adjudicator, whose axis decides between the annotators' and is the one that counts.
    Adjudicator,
}

/// The reason why a name cannot be an annotator's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    /// It has no letter or digit.
    #[error("an annotator's name needs a letter")]
    Empty,
    /// It is longer than a file's name may grow.
    #[error("an annotator's name has at most {} bytes", Author::LONGEST)]
    TooLong,
    /// It holds a line end or another control character.
    #[error("an annotator's name is one line of text")]
    Control,
    /// It is a number, which in a file's name would be the number of a copy.
    #[error("an annotator's name is more than a number")]
    Number,
    /// It is the word that the adjudicated axis has in a file's name.
    #[error("\"adjudicated\" is kept for the adjudicated axis, and cannot be an annotator's name")]
    Reserved,
}

/// A person, and the role in which an axis is set.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Author {
    name: String,
    role: Role,
}

/// The author's part in the names of the adjudicated axis's files.
const ADJUDICATED: &str = "adjudicated";

impl Author {
    /// The longest name in bytes.
    pub const LONGEST: usize = 64;

    /// Creates an annotator. White space around the name is dropped.
    ///
    /// # Errors
    /// Returns an error if the name is empty, too long, a number, reserved, or not one line.
    pub fn annotator(name: &str) -> Result<Self, NameError> {
        Self::new(name, Role::Annotator)
    }

    /// Creates an adjudicator, who decides between the annotators. Each cloud has one adjudicated axis, whoever set it.
    ///
    /// # Errors
    /// Returns an error as [`Author::annotator`] does.
    pub fn adjudicator(name: &str) -> Result<Self, NameError> {
        Self::new(name, Role::Adjudicator)
    }

    fn new(name: &str, role: Role) -> Result<Self, NameError> {
        let name = name.trim();
        if name.chars().any(char::is_control) {
            return Err(NameError::Control);
        }
        if name.len() > Self::LONGEST {
            return Err(NameError::TooLong);
        }
        let slug = slug(name);
        if !slug.chars().any(char::is_alphanumeric) {
            return Err(NameError::Empty);
        }
        if slug.chars().all(|c| c.is_ascii_digit()) {
            return Err(NameError::Number);
        }
        if slug.eq_ignore_ascii_case(ADJUDICATED) {
            return Err(NameError::Reserved);
        }
        Ok(Self {
            name: name.into(),
            role,
        })
    }

    /// The name as it was given.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The role.
    pub fn role(&self) -> Role {
        self.role
    }

    /// Returns the author's part of a file name: letters and digits of any script, `-` and `_` as they are, every run of
    /// other characters as one `-`. Two names with the same slug are told apart by the content of the files. An
    /// adjudicator's slug is `adjudicated`, whatever the name.
    pub fn slug(&self) -> String {
        match self.role {
            Role::Annotator => slug(&self.name),
            Role::Adjudicator => ADJUDICATED.into(),
        }
    }

    /// The `copy`-th file (from 1) for the author's axis beside a cloud: `CLOUD.NAME.axis.json`, then
    /// `CLOUD.NAME.2.axis.json` where the first must not be touched.
    pub fn axis_path(&self, cloud: &Path, copy: u32) -> PathBuf {
        self.path(cloud, copy, AXIS_ENDING)
    }

    /// The journal of the author's edits, likewise: `CLOUD.NAME.axis.journal`.
    pub fn journal_path(&self, cloud: &Path, copy: u32) -> PathBuf {
        self.path(cloud, copy, ".axis.journal")
    }

    fn path(&self, cloud: &Path, copy: u32, ending: &str) -> PathBuf {
        let mut name = OsString::from(cloud.file_stem().unwrap_or_default());
        name.push(format!(".{}", self.slug()));
        if copy > 1 {
            name.push(format!(".{copy}"));
        }
        name.push(ending);
        cloud.with_file_name(name)
    }
}

/// The ending of the names of axis files.
pub const AXIS_ENDING: &str = ".axis.json";

/// Parses the name of an axis file: the slug and the number of the copy. Returns `None` if it is not an axis file of this
/// cloud.
pub fn axis_file_of(cloud: &Path, name: &OsStr) -> Option<(String, u32)> {
    // The name of the cloud need not be Unicode, the rest is.
    let middle = name
        .as_encoded_bytes()
        .strip_prefix(cloud.file_stem()?.as_encoded_bytes())?
        .strip_prefix(b".")?
        .strip_suffix(AXIS_ENDING.as_bytes())?;
    let middle = std::str::from_utf8(middle).ok()?;
    let (slug, copy) = match middle.rsplit_once('.') {
        None => (middle, 1),
        Some((slug, copy)) => (slug, copy.parse().ok().filter(|&copy| copy > 1)?),
    };
    // A number in place of the slug: the file is a copy that belongs to a cloud with a longer name.
    let is_slug = !slug.is_empty() && !slug.contains('.') && slug.chars().any(|c| !c.is_ascii_digit());
    is_slug.then(|| (slug.to_owned(), copy))
}

fn slug(name: &str) -> String {
    let mut slug = String::new();
    for c in name.chars() {
        if c.is_alphanumeric() || c == '_' {
            slug.push(c);
        } else if !slug.ends_with('-') {
            slug.push('-');
        }
    }
    slug.trim_matches('-').into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_safe_parts_of_file_names() {
        let cases = [
            ("Ada", "Ada"),
            ("  Ada Lovelace ", "Ada-Lovelace"),
            ("a/../b", "a-b"),
            ("Łukasz_2", "Łukasz_2"),
            ("x.y:z*", "x-y-z"),
        ];
        for (name, slug) in cases {
            assert_eq!(Author::annotator(name).expect(name).slug(), slug);
        }
        let wrong = [
            ("", NameError::Empty),
            (" ../ ", NameError::Empty),
            ("a\nb", NameError::Control),
            ("12", NameError::Number),
            ("Adjudicated", NameError::Reserved),
            (&"a".repeat(65), NameError::TooLong),
        ];
        for (name, error) in wrong {
            assert_eq!(Author::annotator(name), Err(error), "{name:?}");
        }
    }

    #[test]
    fn a_file_s_name_tells_whose_it_is() {
        let cloud = Path::new("data/pepper.v1.ply");
        let ada = Author::annotator("Ada B").expect("a name");
        for copy in [1, 2, 13] {
            let path = ada.axis_path(cloud, copy);
            let name = path.file_name().expect("a name");
            assert_eq!(path.parent(), cloud.parent());
            assert_eq!(axis_file_of(cloud, name), Some(("Ada-B".into(), copy)));
        }
        let others = [
            "pepper.v1.axis.json",
            "pepper.v1.2.axis.json",
            "pepper.v1.Ada.x.axis.json",
            "pepper.v1.Ada.1.axis.json",
            "pepper.v1.Ada.axis.json.tmp",
            "pepper.v2.Ada.axis.json",
            "pepper.v1..axis.json",
        ];
        for name in others {
            assert_eq!(axis_file_of(cloud, OsStr::new(name)), None, "{name}");
        }
        let adjudicator = Author::adjudicator("Ada").expect("a name");
        assert!(
            adjudicator
                .axis_path(cloud, 1)
                .ends_with("pepper.v1.adjudicated.axis.json")
        );
    }
}
