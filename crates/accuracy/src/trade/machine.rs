//! The machine that times are measured on, by name.

/// Processor, cores, system and version of this program, as far as the system tells.
///
/// Times of different machines are not comparable; a table of times says whose they are.
pub fn machine() -> String {
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let processor = processor.unwrap_or_else(|| "unnamed processor".to_owned());
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let build = if cfg!(debug_assertions) {
        "debug build"
    } else {
        "release build"
    };
    format!(
        "{processor}, {cores} cores, {} {}, vibro-audit {} ({build})",
        std::env::consts::OS,
        std::env::consts::ARCH,
        env!("CARGO_PKG_VERSION"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_machine_has_cores_and_a_system() {
        let machine = machine();
        assert!(
            machine.contains(" cores, ") && machine.contains(std::env::consts::ARCH),
            "{machine}"
        );
    }
}
