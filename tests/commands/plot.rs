//! `plot` as a reader sees it: what stands in each figure, that it is XML, that it is the same each time.

use crate::common::program::{Program, program, scratch};
use roxmltree::{Document, Node};
use std::fs;
use std::path::Path;

/// `plot` with these arguments, on two threads.
fn plot(arguments: &[&str]) -> Program {
    program([&["plot"], arguments].concat()).threads(2)
}

/// What `plot` prints for these arguments.
fn plotted(arguments: &[&str]) -> String {
    plot(arguments).run().succeeded()
}

fn assert_refused(arguments: &[&str], words: &[&str]) {
    let message = plot(arguments).run().refused(words);
    assert!(message.starts_with("error: "), "{message}");
}

/// The text of a figure, which must be XML, in fonts of 11 pixels or more (subscripts of 7.5), with no number that is none.
fn texts(name: &str, svg: &str) -> Vec<String> {
    let document = Document::parse(svg).unwrap_or_else(|error| panic!("{name}: {error}"));
    let number = |node: Node, key: &str| node.attribute(key).and_then(|text| text.parse::<f64>().ok());
    let root = document.root_element();
    let view: Vec<f64> = root
        .attribute("viewBox")
        .unwrap()
        .split(' ')
        .map(|side| side.parse().unwrap())
        .collect();
    let pixel = view[2] / number(root, "width").unwrap();
    for node in document.descendants() {
        let least = if node.has_tag_name("tspan") { 7.5 } else { 11.0 };
        if let Some(size) = number(node, "font-size") {
            assert!(size / pixel >= least, "{name}: {size} of {:?}", node.text());
        }
    }
    for path in document.descendants().filter_map(|node| node.attribute("d")) {
        assert!(!path.contains("NaN") && !path.contains("inf"), "{name}");
    }
    let nodes = document.descendants().filter(|node| node.has_tag_name("text"));
    // a subscript is a part in a font of its own
    let typed = |part: Node| {
        let is_below = part
            .parent()
            .is_some_and(|above| above.has_attribute("dy") && above.has_attribute("font-size"));
        format!("{}{}", if is_below { "_" } else { "" }, part.text().unwrap_or_default())
    };
    let whole = |node: Node| node.descendants().filter(|part| part.is_text()).map(typed).collect();
    nodes.map(whole).collect()
}

fn assert_says(name: &str, texts: &[String], wanted: &[&str]) {
    for wanted in wanted {
        assert!(
            texts.iter().any(|text| text.contains(wanted)),
            "{name} does not say `{wanted}`: {texts:#?}"
        );
    }
}

const ENERGY: [&str; 8] = [
    "Velocity of the impacts",
    "Voltage of the impacts",
    "gap d",
    "velocity before impact",
    "output voltage  [kV]",
    "simulated impacts, bottom",
    "simulated impacts, top",
    "mean voltage",
];

#[test]
fn every_figure_of_the_paper_is_drawn_with_all_its_labels_the_same_on_any_number_of_threads() {
    let scratch = scratch("all");
    let [full, one, other] = ["full", "one", "other"].map(|name| scratch.path(name));
    // of few values: how many do not change how they are shared out
    let few = ["--set", "sweep.points=41"];
    for (directory, threads, sets) in [(&full, 3, &few[..0]), (&one, 1, &few), (&other, 3, &few)] {
        let arguments = ["all", "--out", directory, "--format", "csv"];
        let all = plot(&[&arguments[..], sets].concat()).threads(threads);
        let rows = all.run().succeeded();
        assert_eq!(rows.lines().count(), 14, "{rows}");
        assert!(rows.starts_with("figure,file,bytes\nfig02,"), "{rows}");
    }
    for number in 2..=14 {
        let name = format!("fig{number:02}.svg");
        let [svg, by_one, by_three] =
            [&full, &one, &other].map(|directory| fs::read_to_string(Path::new(directory).join(&name)).unwrap());
        assert_eq!(by_one, by_three, "{name}");
        assert!(svg.len() < 300_000, "{name}: {}", svg.len());
        let texts = texts(&name, &svg);
        assert_says(&name, &texts, &[&format!("Fig. {number}")]);
        let wanted: &[&str] = match number {
            2..=10 => &ENERGY,
            11 => &[
                "Velocity of the impacts",
                "Phase of the impacts",
                "\u{3c6}",
                "1.21387",
                "0.922985",
                "printed value: wrong",
            ],
            12 | 13 => &[
                "Phase portrait",
                "walls",
                "Motion of capsule and ball",
                "ball",
                "time t  [\u{3c0}/\u{3c9}]",
            ],
            _ => &["mean output voltage  [kV]", "Fig. 2:", "Fig. 10:"],
        };
        assert_says(&name, &texts, wanted);
    }
    assert_eq!(fs::read_dir(&full).unwrap().count(), 13);
}

#[test]
fn bifurcations_and_printed_points_are_marked_right_and_wrong_apart() {
    let texts = texts("fig03", &plotted(&["fig03", "--set", "sweep.points=81"]));
    let wanted = [
        "orbit BT, stable",
        "orbit BT, unstable",
        "orbit BT, unphysical (through a wall)",
        "period doubling of an unphysical orbit",
        "grazing",
        "period doubling",
        "fold",
        "printed value: reproduced",
        "printed value: rounded",
        "printed value: wrong",
        "printed bifurcation: wrong",
        "0.701752",
        "\u{2212}0.555468",
    ];
    assert_says("fig03", &texts, &wanted);
}

#[test]
fn another_motion_than_the_paper_has_no_printed_points() {
    let other = texts(
        "other",
        &plotted(&["fig03", "--set", "sweep.points=11", "--set", "motion.r_b=0.61"]),
    );
    assert!(other.iter().all(|text| !text.contains("printed")), "{other:?}");
}

#[test]
fn only_what_is_wanted_is_drawn_and_the_file_is_what_stdout_has() {
    let scratch = scratch("wanted");
    let arguments = ["fig02", "--set", "want=['branch']", "--set", "sweep.points=21"];
    let svg = plotted(&arguments);
    let texts = texts("branch alone", &svg);
    assert_says("branch alone", &texts, &["orbit BT, stable", "Phase of the impacts"]);
    assert!(
        texts
            .iter()
            .all(|text| !text.contains("simulated") && !text.contains("voltage")),
        "{texts:?}"
    );
    let file = scratch.path("figure.svg");
    assert!(plotted(&[&arguments[..], &["--out", &file]].concat()).is_empty());
    assert_eq!(fs::read_to_string(&file).unwrap(), svg);
}

#[test]
fn any_parameter_may_be_swept_and_any_word_followed() {
    let sets = [
        "sweep.over=r_t",
        "sweep.from=0.5",
        "sweep.to=0.3",
        "sweep.points=11",
        "words=['BT', 'BTT']",
        "motion.d=0.26",
    ];
    let arguments: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let svg = plotted(&[&["fig03"], &arguments[..]].concat());
    assert_says(
        "r_t",
        &texts("r_t", &svg),
        &["restitution of the top, r_T", "orbit BT, stable", "orbit BTT, stable"],
    );
}

/// The heading of a map of words.
const CYCLES: &str = "Impacts of a cycle (B bottom, T top, * rest)";

#[test]
fn curves_over_two_parameters_are_drawn_over_their_map_and_alone() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/curves.toml");
    let small = ["--set", "map.x.points=4", "--set", "map.y.points=3"];
    let curves = [
        "period doubling",
        "fold",
        "grazing",
        "fold of an unphysical motion",
        "cusp",
    ];
    let over = texts("over a map", &plotted(&[&[scene], &small[..]].concat()));
    assert_says("over a map", &over, &[&curves[..], &[CYCLES, "BT"]].concat());
    let alone = texts("alone", &plotted(&[scene, "--set", "want=['branch']"]));
    assert_says("alone", &alone, &curves);
    assert!(!alone.iter().any(|text| text == CYCLES), "{alone:?}");
    assert_refused(
        &[scene, "--set", "branch.y.over=d", "--set", "motion.r_b=0.5"],
        &["branch.y.over", "another parameter than d"],
    );
    assert_refused(
        &[scene, "--set", "branch.y.to=0.2"],
        &["branch.y.to", "other than branch.y.from"],
    );
    assert_refused(&[scene, "--set", "branch.y.to=1.2"], &["branch.y.to", "from 0 to 1"]);
}

#[test]
fn the_attractors_are_marked_in_their_basins_over_multiples_of_pi() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/basins.toml");
    let small = ["--set", "basins.phase.points=4", "--set", "basins.velocity.points=3"];
    let svg = plotted(&[&[scene], &small[..]].concat());
    let texts = texts("basins", &svg);
    let wanted = [
        "Attractor reached (B bottom, T top, * rest)",
        "bottom impacts of each cycle without rest",
        "1",
        "2",
        "3\u{3c0}/2",
        "phase of the first impact, \u{3c6}  [rad]",
    ];
    assert!(
        wanted.iter().all(|wanted| texts.iter().any(|text| text == wanted)),
        "{texts:?}"
    );
    // no file name stands above a scene without a title
    assert!(!texts.iter().any(|text| text.contains("basins")), "{texts:?}");
    assert!(
        svg.contains("shape-rendering=\"crispEdges\"") && svg.contains("<tspan font-style=\"italic\">\u{3c6}</tspan>")
    );
}

#[test]
fn numbers_on_a_map_have_a_bar_of_colours_with_round_ticks() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/map.toml");
    let sets = ["map.x.points=5", "map.y.points=4", "map.want=['lyapunov']"];
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let texts = texts(
        "lyapunov",
        &plotted(&[scene].into_iter().chain(sets).collect::<Vec<_>>()),
    );
    let wanted = [
        "Lyapunov exponent",
        "Lyapunov exponent  [\u{3c9}/\u{3c0}]",
        "0.0",
        "infinite",
    ];
    assert!(
        wanted.iter().all(|wanted| texts.iter().any(|text| text == wanted)),
        "{texts:?}"
    );
}

#[test]
fn a_png_is_what_its_name_says_and_a_narrow_figure_has_its_panels_below_each_other() {
    let scratch = scratch("png");
    let file = scratch.path("figure.PNG");
    assert!(plotted(&["fig12", "--out", &file]).is_empty());
    let bytes = fs::read(&file).unwrap();
    assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"));
    // five pixels for two of the SVG
    let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!(side(16), 2250);
    let narrow = plotted(&["fig12", "--narrow"]);
    let document = Document::parse(&narrow).unwrap();
    let [width, height] =
        ["width", "height"].map(|side| document.root_element().attribute(side).unwrap().parse::<f64>().unwrap());
    assert!(width == 420.0 && height > 640.0, "{width} x {height}");
    // at 8.5 cm text is of 6.5 points or more, as journals ask for
    let points = 8.5 / 2.54 * 72.0 / width;
    let sizes = document.descendants().filter(|node| node.has_tag_name("text"));
    let least = sizes.map(|node| node.attribute("font-size").unwrap().parse::<f64>().unwrap() / 10.0);
    assert!(least.fold(99.0, f64::min) * points > 6.5);
    assert_refused(
        &["fig12", "--out", &scratch.path("figure.pdf")],
        &["SVG and PNG, not PDF"],
    );
}

#[test]
fn the_scenes_of_the_examples_are_drawn() {
    for (file, sets, wanted) in [
        ("map.toml", ["map.x.points=4", "map.y.points=3"], "BTBT"),
        (
            "basins.toml",
            ["basins.phase.points=4", "basins.velocity.points=3"],
            "BBT",
        ),
    ] {
        let scene = format!("{}/examples/{file}", env!("CARGO_MANIFEST_DIR"));
        let arguments = [&scene, "--set", sets[0], "--set", sets[1]];
        assert_says(file, &texts(file, &plotted(&arguments)), &[wanted]);
    }
}

#[test]
fn the_best_device_of_a_box_is_drawn_among_the_others() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/optimum.toml");
    let frame = "region proved to hold the best device";
    let several = texts("three parameters", &plotted(&[scene]));
    assert_says(
        "three parameters",
        &several,
        &[
            "The best device of a box",
            "Devices with r_T = 0.24",
            "Devices with d = 0.6000",
            "no stable motion",
            "best device, 143.907 kV",
        ],
    );
    // the best one is known to less than a ring
    assert!(!several.iter().any(|text| text == frame), "{several:?}");
    let fig03 = |name: &str, set: &str| {
        let sets = ["fig03", "--set", "want=['optimum']", "--set", set];
        texts(name, &plotted(&sets))
    };
    let one = fig03("one parameter", "box={d = [0.1, 0.6]}");
    assert_says(
        "one parameter",
        &one,
        &["voltage per forcing period  [kV]", "best device, 138.335 kV"],
    );
    let none = fig03("nothing", "box={d = [0.21, 0.23], r_b = [0.6, 0.6001]}");
    assert_says("nothing", &none, &["no stable motion"]);
    assert!(!none.iter().any(|text| text.starts_with("best device")), "{none:?}");
}

#[test]
fn what_cannot_be_drawn_or_written_is_refused_by_name() {
    let scratch = scratch("refused");
    let file = scratch.path("file");
    fs::write(&file, "mine").unwrap();
    assert_refused(&["all"], &["--out DIR"]);
    assert_refused(&["all", "--out", &file], &[&file, "creating the directory"]);
    assert_refused(
        &["all", "--out", &scratch.path("new"), "--set", "motion.d=-1"],
        &["motion.d"],
    );
    assert!(!Path::new(&scratch.path("new")).exists());
    assert_refused(&["fig99"], &["fig99"]);
    assert_refused(
        &["fig02", "--set", "want=['orbits']"],
        &["fig02", "branch, sweep, voltage, trajectory, map, basins"],
    );
    assert_refused(
        &["fig12", "--out", &scratch.path("none/figure.svg")],
        &["there is no directory"],
    );
    assert_refused(&["fig11", "--set", "sweep.points=0"], &["sweep.points"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
}
