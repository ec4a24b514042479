//! The formulas of the paper, byte for byte as printed, and the vocabulary they need.

use vibro_audit::tex::{Names, read_name};

/// The paper's functions and its matrix.
pub fn names() -> Names {
    let plain = Names::default();
    let name = |tex: &str| read_name(tex, &plain).expect("a name");
    let functions = ["f", "F_1", "F_2", "Z", r"\dot{Z}", r"\ddot{X}"];
    Names {
        functions: functions.iter().map(|tex| name(tex)).collect(),
        words: vec!["eta".into()],
        matrices: vec![vibro_audit::tex::Name {
            base: "DP".into(),
            ..Default::default()
        }],
        ..Names::default()
    }
}

/// Number, how many equations stand there, TeX.
pub const PAPER: &[(&str, usize, &str)] = &[
    ("1", 1, r"\ddot{X}(\tau) = \frac{\hat{F}(w\tau + \phi)}{M} \tag{1}"),
    (
        "3",
        1,
        r"\dot{Z}(t) = -r\dot{Z}^{-}(t_k) + \overline{g}(t - t_k) + F_1(t) - F_1(t_k)",
    ),
    (
        "4",
        1,
        r"Z(t) = Z_k^- - r\dot{Z}_k^-(t - t_k) + \frac{\overline{g}}{2}(t - t_k)^2 + F_2(t) - F_2(t_k) - F_1(t_k)(t - t_k), \tag{4}",
    ),
    (
        "5",
        1,
        r"U_k^{imp} = \left[\frac{A_k}{\pi R_c^2}\right]^2 U_{in},\tag{5}",
    ),
    ("6", 1, r"U_k = U_k^{imp} - U_{in} \tag{6}"),
    (
        "9",
        1,
        r"\dot{Z}_{k+1} = -r_B \dot{Z}_k + \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k)",
    ),
    (
        "10",
        1,
        r"-d = -r_B \dot{Z}_k T_1 + \frac{\overline{g}}{2} T_1^2 + F_2(t_{k+1}) - F_2(t_k) - F_1(t_k) T_1",
    ),
    (
        "11",
        1,
        r"\dot{Z}_{k+2} = -r_T \dot{Z}_{k+1} + \overline{g}T_2 + F_1(t_{k+2}) - F_1(t_{k+1})",
    ),
    (
        "12",
        1,
        r"d = -r_T \dot{Z}_{k+1} T_2 + \frac{\overline{g}}{2} T_2^2 + F_2(t_{k+2}) - F_2(t_{k+1}) - F_1(t_{k+1}) T_2",
    ),
    (
        "13",
        6,
        r"Z_{k+2} = Z_k, \dot{Z}_{k+2} = \dot{Z}_k, T = T_1 + T_2, f(t) = f(t+T), F_1(t) = F_1(t+T), F_2(t) = F_2(t+T)",
    ),
    (
        "14",
        1,
        r"\dot{Z}_k = \frac{1}{1 - r_B r_T} [\overline{g}T - (1 + r_T)(\overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k))]. \tag{14}",
    ),
    (
        "15",
        1,
        r"\dot{Z}_{k} = \frac{1}{r_{B}T_{1} - r_{B}r_{T}T_{2}} \left[\frac{\overline{g}}{2} (T_{1}^{2} + T_{2}^{2}) - r_{T}T_{2} (\overline{g}T_{1} + F_{1}(t_{k+1}) - F_{1}(t_{k})) - F_{1}(t_{k})T_{1} - F_{1}(t_{k+1})T_{2} \right]. \tag{15}",
    ),
    (
        "16",
        1,
        r"\dot{Z}_k = \frac{1}{r_B T_1} \left[d + \frac{\overline{g}}{2} T_1^2 + F_2(t_{k+1}) - F_2(t_k) \right] - F_1(t_k) T_1.",
    ),
    (
        "19",
        2,
        r"\lambda_{1,2} = \frac{Tr(DP) \pm \sqrt{\Delta}}{2}, \qquad \Delta = [Tr(DP)]^2 - 4 \cdot Det(DP)",
    ),
    (
        "20",
        1,
        r"\frac{\partial t_{k+1}}{\partial t_{k}} = \frac{r_{B}\dot{Z}_{k} - \overline{g}T_{1} - f(t_{k})T_{1}}{r_{B}\dot{Z}_{k} - \overline{g}T_{1} - F_{1}(t_{k+1}) + F_{1}(t_{k})},",
    ),
    (
        "20",
        1,
        r"\frac{\partial t_{k+1}}{\partial \dot{Z}_{k}} = \frac{-r_{B}T_{1}}{r_{B}\dot{Z}_{k} - \overline{g}T_{1} - F_{1}(t_{k+1}) + F_{1}(t_{k})},",
    ),
    (
        "20",
        1,
        r"\frac{\partial \dot{Z}_{k+1}}{\partial t_{k}} = \frac{\partial t_{k+1}}{\partial t_{k}} [f(t_{k+1}) + \overline{g}] - [f(t_{k}) + \overline{g}],",
    ),
    (
        "20",
        1,
        r"\frac{\partial \dot{Z}_{k+1}}{\partial \dot{Z}_{k}} = -r_{B} + \frac{\partial t_{k+1}}{\partial \dot{Z}_{k}} [f(t_{k+1}) + \overline{g}],",
    ),
    (
        "21",
        4,
        r"\frac{\partial t_{k+2}}{\partial t_{k+1}} = \frac{r_T \dot{Z}_{k+1} - \overline{g} T_2 - f(t_{k+1}) T_2}{r_T \dot{Z}_{k+1} - \overline{g} T_2 - F_1(t_{k+2}) + F_1(t_{k+1})},
\frac{\partial t_{k+2}}{\partial \dot{Z}_{k+1}} = \frac{-r_T T_2}{r_T \dot{Z}_{k+1} - \overline{g} T_2 - F_1(t_{k+2}) + F_1(t_{k+1})},
\frac{\partial \dot{Z}_{k+2}}{\partial t_{k+1}} = \frac{\partial t_{k+2}}{\partial t_{k+1}} [f(t_{k+2}) + \overline{g}] - [f(t_{k+1}) + \overline{g}],
\frac{\partial \dot{Z}_{k+2}}{\partial \dot{Z}_{k+1}} = -r_T + \frac{\partial t_{k+2}}{\partial \dot{Z}_{k+1}} [f(t_{k+2}) + \overline{g}].",
    ),
    (
        "22",
        1,
        r"Tr(DP) = \frac{1}{\epsilon_1 \epsilon_2} [r_B + r_B T_1(f(t_{k+1}) + \overline{g})] \cdot [r_T - r_T T_2(f(t_k) + \overline{g})] - \frac{\epsilon_3 \epsilon_4}{\epsilon_1 \epsilon_2} - \frac{r_T T_2}{\epsilon_2} [f(t_k) + \overline{g} + \frac{\epsilon_4}{\epsilon_1} (f(t_{k+1}) + \overline{g})] + \frac{r_B T_1}{\epsilon_1} [f(t_{k+1}) + \overline{g} - \frac{\epsilon_3}{\epsilon_2} (f(t_k) + \overline{g})],",
    ),
    (
        "23",
        1,
        r"Det(DP) = \frac{r_B^2 r_T^2 \dot{Z}_k}{F_1(t_k) - F_1(t_{k+1}) + r_T F_1(t_k) - r_T F_1(t_{k+1}) + \overline{g} T_2 - \overline{g} r_T T_1 + \dot{Z}_k r_B r_T}, \quad (23)",
    ),
    (
        "22",
        1,
        r"\epsilon_1 = F_1(t_k) - F_1(t_{k+1}) + \dot{Z}_k r_B - \overline{g} T_1",
    ),
    (
        "22",
        1,
        r"\epsilon_2 = F_1(t_k) - F_1(t_{k+1}) + \overline{g} T_2 + r_T \epsilon_1",
    ),
    (
        "22",
        1,
        r"\epsilon_3 = f(t_{k+1}) T_2 + \overline{g} T_2 + r_T \epsilon_1",
    ),
    ("22", 1, r"\epsilon_4 = f(t_k) T_1 + \overline{g} T_1 + \dot{Z}_k r_B"),
];
