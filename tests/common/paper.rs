//! The claims of the paper that are true, as printed or mended, and sheets made of them.

use vibro_audit::claim::{Fault, Role, Sheet, read_symbols};
use vibro_audit::prove::{self, Decision, Options};
use vibro_audit::tex::{Equation, Symbols, read};

pub const PAPER: &str = include_str!("../../golden/paper/equations.toml");
pub const SYMBOLS: &str = include_str!("../../golden/paper/symbols.toml");

pub fn vocabulary() -> Symbols {
    read_symbols(SYMBOLS).unwrap_or_else(|fault| panic!("{fault}"))
}

/// A true claim of the paper.
#[derive(Clone)]
pub struct Claim {
    /// Its label in the sheet.
    pub label: &'static str,
    pub tex: String,
    pub local: Vec<String>,
    /// The premises by the names that the judge has for them.
    pub premises: &'static [&'static str],
}

/// A sheet that holds the premises of the paper's claim `label`, and other claims in its place: TeX and definitions.
pub struct Bench {
    pub paper: Sheet,
    pub symbols: Symbols,
}

impl Bench {
    pub fn new() -> Self {
        let symbols = vocabulary();
        let paper = Sheet::read(PAPER, &symbols).unwrap_or_else(|fault| panic!("{fault}"));
        Self { paper, symbols }
    }

    pub fn read(&self, tex: &str) -> Vec<Equation> {
        read(tex, &self.symbols.names).unwrap_or_else(|error| panic!("{tex}\n{error}"))
    }

    /// What is printed under a label.
    pub fn printed(&self, label: &str) -> (String, Vec<String>) {
        let entry = &self.paper.entries[self.paper.find(label).expect("a label of the paper")];
        let local = entry.local.iter().map(|(_, source)| source.tex.clone()).collect();
        (entry.tex.tex.clone(), local)
    }

    /// The true claims: those that the paper prints right, and (16) and (22) mended.
    pub fn claims(&self) -> Vec<Claim> {
        let all: &[(&str, &[&str])] = &[
            ("3", &["motion"]),
            ("4", &["motion"]),
            ("9", &["9"]),
            ("10", &["9", "10"]),
            ("11", &["11"]),
            ("12", &["11", "12"]),
            ("14", &["9", "11", "13"]),
            ("15", &["9", "10", "12", "13"]),
            ("16", &["10"]),
            ("19", &["characteristic"]),
            ("20", &["9", "10"]),
            ("21", &["11", "12"]),
            ("22", &["9", "10", "11", "12", "13"]),
            ("23", &["9", "10", "11", "12", "13"]),
        ];
        let mut claims: Vec<Claim> = all
            .iter()
            .map(|&(label, premises)| {
                let (tex, local) = self.printed(label);
                Claim {
                    label,
                    tex,
                    local,
                    premises,
                }
            })
            .collect();
        for claim in &mut claims {
            match claim.label {
                "16" => {
                    claim.tex = claim
                        .tex
                        .replace(r"F_2(t_k) \right] - F_1(t_k) T_1.", r"F_2(t_k) - F_1(t_k) T_1 \right].");
                }
                "22" => {
                    claim.tex = claim.tex.replace("[r_B + r_B T_1(", r"[r_B \epsilon_1 + r_B T_1(");
                    claim.tex = claim.tex.replace("[r_T - r_T T_2(", r"[r_T \epsilon_2 - r_T T_2(");
                    claim.local[3] = claim.local[3].replace(r"+ \dot{Z}_k r_B", r"- \dot{Z}_k r_B");
                }
                _ => {}
            }
        }
        let determinant = Claim {
            label: "23",
            tex: "Det(DP) = r_B^2 r_T^2".into(),
            local: vec![],
            premises: &["9", "10", "11", "12", "13"],
        };
        claims.push(determinant);
        claims
    }

    /// The sheet with the premises of the paper's `label` and one claim, which is last.
    pub fn sheet(&self, label: &str, tex: &str, local: &[String]) -> String {
        let entry = &self.paper.entries[self.paper.find(label).expect("a label of the paper")];
        let with: Vec<String> = entry.with.iter().map(|(_, source)| source.tex.clone()).collect();
        let premises: Vec<(String, String)> = entry
            .follows_from
            .iter()
            .map(|&n| &self.paper.entries[n])
            .map(|premise| (premise.label.clone(), premise.tex.tex.clone()))
            .collect();
        sheet(&premises, tex, local, &with)
    }

    /// The decision on the last claim of a sheet.
    pub fn decide(&self, text: &str) -> Result<Decision, Fault> {
        let sheet = Sheet::read(text, &self.symbols)?;
        let last = sheet
            .entries
            .iter()
            .rposition(|entry| entry.role == Role::Claim)
            .expect("a claim");
        Ok(prove::decide(&sheet, last, &Options::default()))
    }
}

/// A sheet of premises, label and TeX each, and one claim.
pub fn sheet(premises: &[(String, String)], tex: &str, local: &[String], with: &[String]) -> String {
    let quoted = |list: &[String]| {
        list.iter()
            .map(|tex| format!("'''{tex}'''"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let mut text = String::new();
    let mut labels = Vec::new();
    for (label, tex) in premises {
        text.push_str(&format!(
            "[[equation]]\nlabel = {label:?}\nrole = \"premise\"\ntex = '''{tex}'''\n\n"
        ));
        labels.push(format!("{label:?}"));
    }
    text.push_str(&format!(
        "[[equation]]\nlabel = \"claim\"\nrole = \"claim\"\ntex = '''{tex}'''\nwhere = [{}]\nwith = [{}]\nfollows_from = [{}]\n",
        quoted(local),
        quoted(with),
        labels.join(", ")
    ));
    text
}

/// A list of equations as one display.
pub fn display(equations: &[Equation]) -> String {
    equations
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join(r", \qquad ")
}
