//! Each commit runs a fixed sample of each large corpus; `.ci/long` runs all of it, by CORPUS=all.

/// Returns true if the whole of each corpus is run.
pub fn is_whole() -> bool {
    std::env::var("CORPUS").is_ok_and(|corpus| corpus == "all")
}

/// Returns true if this run takes a part of a corpus: about one in `one_in`, chosen by the part's name, the same in every run.
pub fn takes(name: &str, one_in: u64) -> bool {
    // FNV-1a (Fowler, Noll, Vo 1991), of 64 bits; its low bits alone are poor
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    is_whole() || (hash >> 16) % one_in == 0
}

/// `all` where the corpus is run whole, else `sampled`.
pub fn of<T>(all: T, sampled: T) -> T {
    if is_whole() { all } else { sampled }
}
