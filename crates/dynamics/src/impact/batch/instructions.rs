//! The instructions that lanes are worked with, found out at run time.

use super::flights::Flights;
use super::growth::Growths;
use super::lanes::Lanes;
use super::step;

/// Instructions of the machine. All give the same bits: they do the same operations, each rounded by itself, and differ
/// in how many lanes they do at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// What the crate was compiled for.
    Portable,
    /// Four lanes at once.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Eight lanes at once.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Instructions that this machine has, which is what makes them safe to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Available(Instructions);

impl Instructions {
    /// All that this machine has, the slowest first.
    pub fn all() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        let known = [Self::Portable, Self::Avx2, Self::Avx512];
        #[cfg(not(target_arch = "x86_64"))]
        let known = [Self::Portable];
        known.into_iter().filter(|one| one.is_here()).collect()
    }

    fn is_here(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
        }
    }
}

impl Available {
    /// The fastest.
    pub fn fastest() -> Self {
        let fastest = Instructions::all().last().copied();
        Self::or_portable(fastest.unwrap_or(Instructions::Portable))
    }

    /// Those that are wanted, or the portable ones where this machine does not have them.
    pub fn or_portable(wanted: Instructions) -> Self {
        Self(if wanted.is_here() {
            wanted
        } else {
            Instructions::Portable
        })
    }

    pub fn instructions(self) -> Instructions {
        self.0
    }

    /// The next flight of every lane.
    #[inline]
    pub fn step<const GROWTH: bool>(self, lanes: &mut Lanes, flights: &mut Flights, growths: &mut Growths) {
        match self.0 {
            Instructions::Portable => portable::<GROWTH>(lanes, flights, growths),
            // SAFETY: `Available` is made only where the machine was found to have these instructions
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => unsafe { avx2::<GROWTH>(lanes, flights, growths) },
            // SAFETY: the same
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512 => unsafe { avx512::<GROWTH>(lanes, flights, growths) },
        }
    }
}

#[inline(never)]
fn portable<const GROWTH: bool>(lanes: &mut Lanes, flights: &mut Flights, growths: &mut Growths) {
    step::step::<GROWTH>(lanes, flights, growths);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<const GROWTH: bool>(lanes: &mut Lanes, flights: &mut Flights, growths: &mut Growths) {
    step::step::<GROWTH>(lanes, flights, growths);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn avx512<const GROWTH: bool>(lanes: &mut Lanes, flights: &mut Flights, growths: &mut Growths) {
    step::step::<GROWTH>(lanes, flights, growths);
}
