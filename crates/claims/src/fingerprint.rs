//! Fingerprints of entries: equal for entries that are written and read alike, wherever they stand in a file.

use super::entry::{Entry, RawEntry, Role};
use super::fault::Source;
use super::sheet::Sheet;
use std::fmt::{self, Write};
use std::hash::{DefaultHasher, Hasher};
use texmath::Name;

/// A hash of 128 bits over what is written to it.
#[derive(Clone, Debug)]
pub struct Fingerprint(DefaultHasher, DefaultHasher);

impl Default for Fingerprint {
    fn default() -> Self {
        let mut other = DefaultHasher::new();
        other.write(b"other");
        Self(DefaultHasher::new(), other)
    }
}

impl Fingerprint {
    /// Adds a value in the form of its `Debug`, apart from the one before.
    pub fn add(&mut self, value: &dyn fmt::Debug) {
        // a hash takes all that is written
        let _ = writeln!(self, "{value:?}");
    }

    /// Returns the hash.
    pub fn value(&self) -> u128 {
        (u128::from(self.0.finish()) << 64) | u128::from(self.1.finish())
    }
}

impl Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        self.1.write(text.as_bytes());
        Ok(())
    }
}

impl Sheet {
    /// Returns a fingerprint of each entry: of everything that is printed and read of it but its place in the
    /// file and the positions of what it follows from, which depend on other entries.
    pub fn fingerprints(&self) -> Vec<Fingerprint> {
        let printed = self
            .printed()
            .flat_map(|raw| std::iter::repeat_n(raw, raw.ways().len()));
        let each = printed.zip(&self.entries).map(|(raw, entry)| {
            let mut fingerprint = Fingerprint::default();
            raw.write_to(&mut fingerprint);
            entry.write_to(&mut fingerprint);
            fingerprint
        });
        each.collect()
    }

    /// Returns the names that each definition gives, with its label.
    pub fn definitions(&self) -> impl Iterator<Item = (&str, Vec<Name>)> {
        let definitions = self.entries.iter().filter(|entry| entry.role == Role::Definition);
        definitions.map(|entry| (entry.label.as_str(), entry.gives()))
    }

    /// Returns the TeX that is printed of the entry at each position, with what is said beside it.
    pub fn printed_texts(&self) -> Vec<String> {
        let text = |raw: &RawEntry| {
            let lists = [&raw.local, &raw.with, &raw.assume].into_iter().flatten();
            let said = raw.said.iter().map(String::as_str);
            let parts = lists.map(|text| text.get_ref().as_str()).chain(said);
            parts.fold(raw.tex.get_ref().clone(), |all, part| all + "\n" + part)
        };
        let each = self.printed();
        each.flat_map(|raw| std::iter::repeat_n(text(raw), raw.ways().len()))
            .collect()
    }
}

impl RawEntry {
    /// Writes all that the file says, without spans. Every field is named: a new one must be taken or left out.
    fn write_to(&self, to: &mut Fingerprint) {
        let Self {
            label,
            role,
            tex,
            local,
            with,
            assume,
            follows_from,
            expect,
            names,
            guessed,
            standing,
            doubts,
            constants,
            held,
            second_values,
            operators,
            identities,
            columns,
            need_not_hold,
            said,
            marked,
            unread,
            way,
        } = self;
        for text in [label, tex] {
            to.add(text.get_ref());
        }
        for list in [local, with, assume].into_iter().chain(follows_from) {
            to.add(&list.len());
            list.iter().for_each(|text| to.add(text.get_ref()));
        }
        to.add(&(
            follows_from.is_some(),
            role,
            expect,
            names,
            guessed,
            standing,
            doubts,
            constants,
            held,
        ));
        to.add(&(
            second_values,
            operators,
            identities,
            columns,
            need_not_hold,
            said,
            marked,
            unread,
            way,
        ));
    }
}

impl Entry {
    /// Writes all that is read, without places. Every field is named: a new one must be taken or left out.
    fn write_to(&self, to: &mut Fingerprint) {
        let Self {
            label,
            role,
            tex,
            equations,
            local,
            with,
            assume,
            printed,
            // positions, which the entries themselves stand for
            follows_from: _,
            expect,
            names,
            guessed,
            standing,
            is_implication,
            is_way,
            of_some,
            doubts,
            operators,
            identities,
            columns,
            need_not_hold,
            for_all,
            alternatives,
            unread,
            own,
            stated,
            given,
            borrowed,
        } = self;
        let source = |source: &Source| (source.tex.clone(), source.file.clone());
        to.add(&(
            label,
            role,
            source(tex),
            equations,
            printed,
            expect,
            names,
            guessed,
            standing,
        ));
        for (equation, from) in local.iter().chain(with).chain(given) {
            to.add(&(equation, source(from)));
        }
        for (condition, from) in assume {
            to.add(&(condition, source(from)));
        }
        to.add(&(local.len(), with.len(), given.len(), assume.len()));
        to.add(&(
            is_implication,
            is_way,
            of_some,
            doubts,
            operators,
            identities,
            columns,
            need_not_hold,
        ));
        to.add(&(for_all, alternatives, own, stated, borrowed));
        to.add(&unread.as_ref().map(|fault| &fault.message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::Symbols;

    fn values(text: &str) -> Vec<u128> {
        let sheet = Sheet::read(text, &Symbols::default()).unwrap();
        sheet.fingerprints().iter().map(Fingerprint::value).collect()
    }

    #[test]
    fn a_fingerprint_changes_with_what_is_said_and_not_with_its_place() {
        let sheet = "[symbols]\nparameters = ['a', 'b']\n[[equation]]\nlabel = '1'\nrole = 'premise'\ntex = 'a = b'\n\
                     [[equation]]\nlabel = '2'\nrole = 'claim'\ntex = 'a + b = 2 b'\nfollows_from = ['1']\n";
        let before = values(sheet);
        assert_eq!(
            before,
            values(&format!("# a comment\n\n{}", sheet.replace("label", " label")))
        );
        for (old, new, is_same) in [
            ("tex = 'a = b'", "tex = 'a = -b'", [false, true]),
            ("2 b'", "2 b + 0'", [true, false]),
            ("role = 'claim'", "role = 'claim'\nassume = ['a > 0']", [true, false]),
            ("follows_from = ['1']", "", [true, false]),
            ("'1'\nrole", "'1'\nexpect = 'refuted'\nrole", [false, true]),
        ] {
            let after = values(&sheet.replace(old, new));
            let found: Vec<bool> = before
                .iter()
                .zip(&after)
                .map(|(before, after)| before == after)
                .collect();
            assert_eq!(found, is_same, "{new}");
        }
    }
}
