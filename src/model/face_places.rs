//! Where the faces of an object stand in their file, for messages.
//!
//! Faces follow one another in most files, a line each, so that a few runs
//! say it for all of them.

/// Where a face stands in its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FacePlace {
    /// Its number among all faces of the file, counted from 0.
    pub number: u64,
    /// The line on which it begins, counted from 1, where lines are known.
    pub line: Option<u64>,
}

/// The places of an object's faces.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FacePlaces {
    /// The name of the file, for messages; empty if there is none.
    pub file: String,
    /// Each goes on until the next begins.
    runs: Vec<Run>,
}

/// Faces of which each follows the one before it, on the next line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Run {
    face: u32,
    place: FacePlace,
}

impl Run {
    fn place_of(&self, face: u32) -> FacePlace {
        let beyond = u64::from(face - self.face);
        FacePlace {
            number: self.place.number + beyond,
            line: self.place.line.map(|line| line + beyond),
        }
    }
}

impl FacePlaces {
    /// Notes where a face of the object stands: of those noted, the last.
    pub fn note(&mut self, face: u32, place: FacePlace) {
        if self.runs.last().is_none_or(|run| run.place_of(face) != place) {
            self.runs.push(Run { face, place });
        }
    }

    /// Where a face of the object stands; as if it were alone in its file if
    /// nothing was noted. O(log n) for n runs.
    pub fn place_of(&self, face: u32) -> FacePlace {
        let after = self.runs.partition_point(|run| run.face <= face);
        match after.checked_sub(1) {
            Some(run) => self.runs[run].place_of(face),
            None => FacePlace { number: u64::from(face), line: None },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_on_lines_that_follow_are_one_run() {
        let mut places = FacePlaces::default();
        let noted = [(0, 4, 10), (1, 5, 11), (2, 6, 12), (3, 7, 20), (4, 9, 21)];
        for (face, number, line) in noted {
            places.note(face, FacePlace { number, line: Some(line) });
        }
        assert_eq!(places.runs.len(), 3);
        for (face, number, line) in noted {
            assert_eq!(places.place_of(face), FacePlace { number, line: Some(line) });
        }
        let none = FacePlaces::default().place_of(7);
        assert_eq!(none, FacePlace { number: 7, line: None });
    }
}
