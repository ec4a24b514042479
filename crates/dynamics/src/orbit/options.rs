//! The tolerances and limits of searches that a user may set.

/// How far searches go, and what is taken for the same. A scene sets each by its name under `[options]`.
///
/// None of them decides what is proved: that is proved under any of them, and what a limit cuts off is told as open. More
/// effort leaves less open and costs more time. What is taken for a cycle of a simulated motion, which nobody proves, is
/// said here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitOptions {
    /// 1-1 motions: cells narrower than this in T_1 and psi are not halved again. Two motions nearer to each other than
    /// some times this are left to a wider number.
    pub finest_cell: f64,
    /// 1-1 motions: the cells examined at one value of the parameters, for each forcing period, before what is left is
    /// told as undecided. A search that needs so many is at a motion that is no isolated one.
    pub most_cells: u32,
    /// 1-1 motions over a range: with so many cells of the cover none is halved any more; it stays one, of coarser cells.
    pub most_cover_cells: u32,
    /// 1-1 motions over a range: how often the boxes in which a bifurcation stays undecided are covered again, finer.
    pub most_covers: u32,
    /// Other words: the starts of Newton's method at one value of the parameters, for each impact and forcing period.
    pub word_starts: u32,
    /// Other words over a range: the values at which motions are searched for, both ends among them,
    pub branch_values: u32,
    /// and the starts at each, for each impact and forcing period.
    pub branch_starts: u32,
    /// Continuation: the longest step, in radians and ranges of the parameter. A longer one is proved as well, or halved.
    pub longest_step: f64,
    /// Continuation: where a step shorter than this would be needed, the branch is left: it comes to a point where it is no
    /// single curve.
    pub shortest_step: f64,
    /// Continuation: the steps in one direction before a branch is left. A branch takes some hundred.
    pub most_steps: u32,
    /// Long runs: the most symbols of a word that is looked for among the last impacts.
    pub longest_word: u32,
    /// Long runs: how far two events may lie apart that are taken for the same one a cycle on: in phase, rad, and in
    /// velocity as a part of the greatest one of the cycle.
    ///
    /// Rounding moves a settled motion of f64 by some 1e-16 / (1 - multiplier), so that a multiplier of 1 - 1e-6 still
    /// passes 1e-9; and the two impacts into which a period doubling splits one part as the square root of the distance
    /// from it, so that they are taken for one only where the parameter is within some 1e-18 of the bifurcation.
    pub settled: f64,
    /// Long runs: the most impacts for which a cycle is followed on until it repeats to rounding, and a motion that does not
    /// repeat until it comes to rest: a chaotic transient may do so after some thousand impacts.
    pub settling_impacts: u32,
    /// Long runs: the digits that may be spent on a cycle through a rest. A release forgets what was before, so that the
    /// motion repeats from there; but in a chaotic one each impact takes a third of a digit or so, and one cycle of some
    /// hundred impacts that is to be known to its end may cost as much as all other points of a sweep. Beyond, the motion
    /// is told by means with their errors: with 31, cycles of some hundred impacts are, and a sweep or a map takes a
    /// fraction of the time.
    pub resting_digits: u32,
}

impl OrbitOptions {
    /// What holds where nothing else is said.
    pub const DEFAULT: Self = Self {
        finest_cell: 2e-9,
        most_cells: 200_000,
        most_cover_cells: 400_000,
        most_covers: 10,
        word_starts: 256,
        branch_values: 17,
        branch_starts: 128,
        longest_step: 0.15,
        shortest_step: 1e-7,
        most_steps: 4000,
        longest_word: 60,
        settled: 1e-9,
        settling_impacts: 20_000,
        resting_digits: 200,
    };
}

impl Default for OrbitOptions {
    fn default() -> Self {
        Self::DEFAULT
    }
}
