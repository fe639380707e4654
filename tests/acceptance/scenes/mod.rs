//! Scenes for tests: random soups that are as degenerate as they can be
//! made, cameras in the worst places, shapes by their coordinates.

mod cameras;
mod compare;
mod flats;
mod random;
mod shapes;
mod soups;

pub(crate) use cameras::{orthographic, perspective, random_camera};
pub(crate) use compare::{assert_same_picture, distance};
pub(crate) use flats::{flat_scene, look_at};
pub(crate) use random::{Random, rounds};
pub(crate) use shapes::{cuboid, polygons};
pub(crate) use soups::{Kind, random_card, random_soups};
