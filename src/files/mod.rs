//! Files that come from outside, read up to a limit; and the program's own, written whole or not at all.

mod read;
#[cfg(feature = "reports")]
mod write;

pub use read::{read_at_most, read_regular};
#[cfg(feature = "reports")]
pub use write::{WriteError, is_replaceable, write_all, write_whole};
