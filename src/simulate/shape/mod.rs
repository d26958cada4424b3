//! The parts that simulated fruits are built of: body, peduncle, leaf and colors.

mod body;
mod color;
mod leaf;
mod peduncle;

pub use self::color::FruitColor;
pub(super) use self::{
    body::{Asymmetry, Body, Form},
    color::Paint,
    leaf::Leaf,
    peduncle::Peduncle,
};
