//! Whose outlines are wanted.

/// Whose images the outer outline goes around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OutlineOf {
    /// That of all objects together.
    #[default]
    Scene,
    /// That of each object, in front of others too.
    Objects,
}

impl OutlineOf {
    /// Both.
    pub const ALL: [OutlineOf; 2] = [OutlineOf::Scene, OutlineOf::Objects];

    /// Its name: `scene` or `objects`.
    pub fn name(self) -> &'static str {
        match self {
            OutlineOf::Scene => "scene",
            OutlineOf::Objects => "objects",
        }
    }

    /// The one with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.name() == name)
    }
}
