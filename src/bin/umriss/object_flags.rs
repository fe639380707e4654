//! Flags that say which objects are drawn, and which hide others.

use crate::failure::Failure;
use clap::Args;
use umriss::drawing::{Styles, matches};
use umriss::model::{FeatureOptions, Mesh, Soup};
use umriss::view::ObjectWish;

/// Objects of the models.
#[derive(Args)]
#[command(next_help_heading = "Objects")]
pub(crate) struct ObjectFlags {
    /// Only objects with these names, separated by commas; * stands for any characters
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    include: Vec<String>,
    /// All but objects with these names
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    exclude: Vec<String>,
    /// Objects that hide nothing
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    see_through: Vec<String>,
}

impl ObjectFlags {
    /// Whether any flag was given.
    pub(crate) fn any(&self) -> bool {
        !(self.include.is_empty() && self.exclude.is_empty() && self.see_through.is_empty())
    }

    /// Leaves out objects that are not wanted.
    pub(crate) fn select(&self, soups: &mut Vec<Soup>, styles: &Styles) -> Result<(), Failure> {
        let names: Vec<String> = soups.iter().map(|soup| soup.name.clone()).collect();
        for pattern in self.include.iter().chain(&self.exclude).chain(&self.see_through) {
            if !names.iter().any(|name| matches(pattern, name)) {
                let names = names.join(", ");
                return Err(Failure::usage(format!(
                    "{pattern}: no object has this name, expected some of {names}"
                )));
            }
        }
        let fits = |patterns: &[String], name: &str| patterns.iter().any(|p| matches(p, name));
        soups.retain(|soup| {
            let name = &soup.name;
            let ruled_out = styles.objects.iter().any(|o| o.exclude && matches(&o.name, name));
            (self.include.is_empty() || fits(&self.include, name))
                && !fits(&self.exclude, name)
                && !ruled_out
        });
        if soups.is_empty() {
            return Err(Failure::usage("no object is left to draw"));
        }
        Ok(())
    }

    /// What is wished of each object of a mesh.
    pub(crate) fn wishes(
        &self,
        mesh: &Mesh,
        features: &FeatureOptions,
        styles: &Styles,
    ) -> Vec<ObjectWish> {
        let wish = |name: &str| {
            let see_through = self.see_through.iter().any(|pattern| matches(pattern, name));
            let mut wish = ObjectWish { features: *features, see_through };
            for rule in styles.objects.iter().filter(|rule| matches(&rule.name, name)) {
                wish.see_through |= rule.see_through;
                if let Some(degrees) = rule.crease {
                    wish.features = wish.features.with_crease_degrees(degrees);
                }
            }
            wish
        };
        mesh.objects().iter().map(|object| wish(&object.name)).collect()
    }
}
