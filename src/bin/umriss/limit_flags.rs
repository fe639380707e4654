//! What a run may use: flags, and what the machine has.

use clap::Args;
use umriss::run::Limits;

/// Bounds of every command that computes.
#[derive(Args)]
pub(crate) struct LimitFlags {
    /// Stop when the arrays of the engine would take more than this: bytes, or a number with K, M,
    /// G or T; none for no limit [default: three quarters of the memory that Linux says is
    /// available, no limit elsewhere]
    #[arg(long, value_name = "SIZE", value_parser = parse_size)]
    max_memory: Option<Size>,
    /// Stop when there are more crossings, piercings and intersection segments than this
    #[arg(long, value_name = "N")]
    max_crossings: Option<u64>,
}

/// Bytes; nothing for no limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Size(Option<u64>);

impl LimitFlags {
    /// The limits of a run.
    pub(crate) fn limits(&self) -> Limits {
        let memory = match self.max_memory {
            Some(Size(size)) => size,
            None => available().map(|bytes| bytes / 4 * 3),
        };
        Limits { crossings: self.max_crossings, memory }
    }
}

/// A number of bytes, with a unit of powers of 1024.
fn parse_size(text: &str) -> Result<Size, String> {
    if text == "none" {
        return Ok(Size(None));
    }
    let split = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (digits, unit) = text.split_at(split);
    let shift = match unit.to_ascii_uppercase().as_str() {
        "" | "B" => Some(0),
        "K" | "KB" | "KIB" => Some(10),
        "M" | "MB" | "MIB" => Some(20),
        "G" | "GB" | "GIB" => Some(30),
        "T" | "TB" | "TIB" => Some(40),
        _ => None,
    };
    let bytes = || digits.parse::<u64>().ok()?.checked_mul(1 << shift?);
    match bytes() {
        Some(bytes) if bytes > 0 => Ok(Size(Some(bytes))),
        _ => Err("expected a size like 500M or 2G, or none".to_owned()),
    }
}

/// The memory that Linux would give without swapping; nothing elsewhere.
fn available() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    let free = kilobytes.checked_mul(1024)?;
    Some(allowed().map_or(free, |allowed| free.min(allowed)))
}

/// What is left to the control group of the process, if that is bounded.
fn allowed() -> Option<u64> {
    let read = |name: &str| {
        let text = std::fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?;
        text.trim().parse::<u64>().ok()
    };
    Some(read("memory.max")?.saturating_sub(read("memory.current")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units_of_powers_of_1024() {
        assert_eq!(parse_size("100"), Ok(Size(Some(100))));
        assert_eq!(parse_size("500M"), Ok(Size(Some(500 << 20))));
        assert_eq!(parse_size("2gib"), Ok(Size(Some(2 << 30))));
        assert_eq!(parse_size("none"), Ok(Size(None)));
        for wrong in ["", "0", "G", "-1", "2X", "1.5G", "99999999999T", "99999999999999999999"] {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
    }
}
