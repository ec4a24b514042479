//! The size of formulas once definitions are put in, computed before any of it is built.

use std::cell::Cell;
use std::collections::HashMap;
use texmath::{Name, Symbols, Tree};

/// The nodes of a tree and how deep they are nested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Size {
    pub nodes: usize,
    pub depth: usize,
}

/// The largest formula that definitions put into each other may make: it bounds the time of all later walks and their stack.
pub(super) const LARGEST: Size = Size {
    nodes: 100_000,
    depth: 600,
};

/// Why a formula is not built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum TooLarge {
    #[error("too large once its definitions are put in: more than {} numbers, symbols and operations", LARGEST.nodes)]
    Long,
    #[error("too deep once its definitions are put in: more than {} within each other", LARGEST.depth)]
    Deep,
}

impl Size {
    /// Computes the size of a tree as it stands.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub(super) fn of(tree: &Tree) -> Result<Self, TooLarge> {
        Sizes::new(std::iter::empty()).of(tree)
    }

    /// Computes the size of a tree in which names are replaced all at once; they may occur in what replaces them.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub(super) fn with(tree: &Tree, pairs: &[(Name, Tree)]) -> Result<Self, TooLarge> {
        Sizes::new(std::iter::empty()).replacing(pairs)?.of(tree)
    }
}

/// The sizes of names that stand for trees, each computed once.
pub(super) struct Sizes<'a> {
    meanings: HashMap<&'a Name, &'a Tree>,
    known: HashMap<&'a Name, Size>,
}

impl<'a> Sizes<'a> {
    /// Takes what names stand for; of two meanings of one name the first counts.
    pub(super) fn new(meanings: impl Iterator<Item = (&'a Name, &'a Tree)>) -> Self {
        let mut first = HashMap::new();
        for (name, tree) in meanings {
            first.entry(name).or_insert(tree);
        }
        Self {
            meanings: first,
            known: HashMap::new(),
        }
    }

    /// Takes definitions, and all abbreviations.
    pub(super) fn within_sheet(symbols: &'a Symbols, definitions: impl Iterator<Item = (&'a Name, &'a Tree)>) -> Self {
        Self::new(definitions.chain(symbols.abbreviations()))
    }

    /// Takes what names are replaced by, all at once: they may occur there again.
    ///
    /// # Errors
    /// [`TooLarge`] of what they are replaced by.
    pub(super) fn replacing(mut self, pairs: &'a [(Name, Tree)]) -> Result<Self, TooLarge> {
        let sizes: Vec<Size> = pairs.iter().map(|(_, to)| self.of(to)).collect::<Result<_, _>>()?;
        for ((name, to), size) in pairs.iter().zip(sizes) {
            self.meanings.insert(name, to);
            self.known.insert(name, size);
        }
        Ok(self)
    }

    /// The tree that a name stands for.
    pub(super) fn meaning(&self, name: &Name) -> Option<&'a Tree> {
        self.meanings.get(name).copied()
    }

    /// Computes the size of a tree with all meanings put in.
    ///
    /// # Errors
    /// [`TooLarge`], also of what is defined by itself.
    pub(super) fn of(&mut self, tree: &Tree) -> Result<Size, TooLarge> {
        self.within(tree, LARGEST.depth)
    }

    fn within(&mut self, tree: &Tree, most_deep: usize) -> Result<Size, TooLarge> {
        if let Tree::Symbol(name, _) = tree
            && let Some((&name, &meant)) = self.meanings.get_key_value(name)
        {
            // a name alone is one step more, so that circles end
            let step = usize::from(matches!(meant, Tree::Symbol(..)));
            let below = most_deep.checked_sub(step).ok_or(TooLarge::Deep)?;
            let size = match self.known.get(name) {
                Some(size) if size.depth > below => return Err(TooLarge::Deep),
                Some(size) => *size,
                None => {
                    let size = self.within(meant, below)?;
                    self.known.insert(name, size);
                    size
                }
            };
            return Ok(Size {
                depth: size.depth + step,
                ..size
            });
        }
        let below = most_deep.checked_sub(1).ok_or(TooLarge::Deep)?;
        if let Tree::Partial { of, by, at } = tree {
            for name in [of, by] {
                self.within(&Tree::Symbol(name.clone(), *at), below)?;
            }
        }
        let (mut size, mut failed) = (Size { nodes: 1, depth: 1 }, None);
        tree.find_below(&mut |part| {
            let found = self.within(part, below).and_then(|part| {
                size.depth = size.depth.max(part.depth + 1);
                size.nodes = size.nodes.saturating_add(part.nodes);
                fitting(size)
            });
            failed = found.err();
            failed
        });
        failed.map_or(Ok(size), Err)
    }
}

fn fitting(size: Size) -> Result<Size, TooLarge> {
    if size.nodes > LARGEST.nodes {
        return Err(TooLarge::Long);
    }
    if size.depth > LARGEST.depth {
        return Err(TooLarge::Deep);
    }
    Ok(size)
}

/// The nodes that may still be built, counted whether they stay or not.
pub(super) struct Budget(Cell<usize>);

impl Budget {
    /// Allows one formula.
    pub(super) fn of_formula() -> Self {
        Self(Cell::new(LARGEST.nodes))
    }

    /// Allows the formulas of an entry and of all that it follows from.
    pub(super) fn of_claim() -> Self {
        Self(Cell::new(10 * LARGEST.nodes))
    }

    /// Takes the nodes of trees that are built this often.
    ///
    /// # Errors
    /// As [`Budget::spend`].
    pub(super) fn spend_times(&self, size: Size, times: usize) -> Result<(), TooLarge> {
        let nodes = size.nodes.saturating_mul(times);
        self.spend(Size { nodes, ..size })
    }

    /// Takes the nodes of a tree that is about to be built.
    ///
    /// # Errors
    /// [`TooLarge::Long`] if they are more than are left.
    pub(super) fn spend(&self, size: Size) -> Result<(), TooLarge> {
        self.0.set(self.0.get().checked_sub(size.nodes).ok_or(TooLarge::Long)?);
        Ok(())
    }
}
