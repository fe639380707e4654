//! Input that may never end: pipes and devices are read within the limits of
//! a run.

use super::Run;
use std::io::{self, ErrorKind, Read};

/// The least that a buffer grows by.
const LEAST: usize = 1 << 16;

/// Bytes between two questions whether to go on.
const PIECE: usize = 1 << 24;

impl Run<'_> {
    /// Reads until the input ends, taking the memory from the limits of the
    /// run before it is used. `expected` is how many bytes there should be, 0
    /// if that is not known; `most` is how many are read at most.
    ///
    /// Once the run is stopped, by a limit or otherwise, the bytes end early,
    /// and whoever called asks the run. Their capacity is what was taken, to be
    /// given back with [`Run::give_back`] when they are thrown away.
    ///
    /// # Errors
    ///
    /// If the input cannot be read.
    pub fn read_all(&self, mut input: impl Read, expected: u64, most: u64) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let expected = usize::try_from(expected.min(most)).map_err(|_| ErrorKind::OutOfMemory)?;
        if !self.grow(&mut bytes, expected)? {
            return Ok(bytes);
        }
        loop {
            let left = usize::try_from(most - bytes.len() as u64).unwrap_or(usize::MAX);
            if left == 0 {
                return Ok(bytes);
            }
            if bytes.len() == bytes.capacity() {
                // Whether it goes on is found before there is room for more.
                let mut next = [0; 1];
                if !read_one(&mut input, &mut next)? {
                    return Ok(bytes);
                }
                let more = LEAST.max(bytes.len() / 4).min(left);
                if !self.grow(&mut bytes, more)? {
                    return Ok(bytes);
                }
                bytes.push(next[0]);
                continue;
            }
            let piece = (bytes.capacity() - bytes.len()).min(left).min(PIECE);
            let read = input.by_ref().take(piece as u64).read_to_end(&mut bytes)?;
            self.advance(0);
            if read < piece || self.is_stopped() {
                return Ok(bytes);
            }
        }
    }

    /// Makes room for so many more bytes; false if the run does not allow it.
    fn grow(&self, bytes: &mut Vec<u8>, more: usize) -> io::Result<bool> {
        if self.take(more as u64).is_err() {
            return Ok(false);
        }
        bytes.try_reserve_exact(more).map_err(|_| ErrorKind::OutOfMemory)?;
        Ok(true)
    }
}

/// Whether there was one more byte.
fn read_one(input: &mut impl Read, byte: &mut [u8; 1]) -> io::Result<bool> {
    loop {
        match input.read(byte) {
            Ok(count) => return Ok(count == 1),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::run::{Cancelled, Limits};

    #[test]
    fn all_is_read_whatever_was_expected() {
        let input: Vec<u8> = (0..400_000_u32).map(|i| (i % 251) as u8).collect();
        for expected in [0, 1, 1000, 399_999, 400_000, 400_001, 1 << 20] {
            let run = Run::default();
            assert_eq!(run.read_all(&input[..], expected, u64::MAX).unwrap(), input, "{expected}");
            assert_eq!(run.read_all(&input[..], expected, 70_000).unwrap(), input[..70_000]);
        }
    }

    #[test]
    fn input_without_end_reaches_the_limit() {
        let limits = Limits { crossings: None, memory: Some(1 << 20) };
        let run = Run::default().with_limits(limits);
        let bytes = run.read_all(io::repeat(7), 0, u64::MAX).unwrap();
        assert!(bytes.capacity() <= 1 << 20);
        let stopped = run.check().unwrap_err();
        assert!(matches!(stopped, Cancelled::TooMuchMemory { limit: 0x10_0000, .. }), "{stopped}");
    }

    #[test]
    fn what_was_taken_is_the_capacity() {
        let limits = Limits { crossings: None, memory: Some(1 << 20) };
        let run = Run::default().with_limits(limits);
        for _ in 0..10 {
            let bytes = run.read_all(&[1; 300_000][..], 1000, u64::MAX).unwrap();
            assert_eq!(bytes.len(), 300_000);
            run.give_back(bytes.capacity() as u64);
        }
        assert!(run.check().is_ok());
    }
}
