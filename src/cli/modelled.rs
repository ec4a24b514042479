//! That a scene costs what it wants: no membrane where no voltage is wanted, no growth of errors where nobody asks how
//! many digits hold, no step of a simulation beyond those of the bare loop. Counted, through the commands themselves.

use super::*;
use crate::impact::{Kind, Origin, Simulation};
use crate::model::calls::{Call, counted};
use crate::orbit::Family;
use crate::scene::{Scene, Want};

/// How often each call was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Modelled([u64; Call::ALL.len()]);

impl Modelled {
    fn count(&self, call: Call) -> u64 {
        self.0[call as usize]
    }
}

/// What `work` models: it runs on a thread of its own, parallel parts too, whose counters therefore see all of it.
fn modelled(work: impl FnOnce() + Send) -> Modelled {
    std::thread::scope(|scope| {
        let thread = scope.spawn(|| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
            pool.build().unwrap().install(work);
            Modelled(Call::ALL.map(counted))
        });
        thread.join().unwrap()
    })
}

const WITHOUT: &str = r#"want=["orbits", "branch", "impacts", "sweep", "trajectory"]"#;
const WITH: &str = r#"want=["sweep", "voltage"]"#;

/// Fig. 3, which has a [membrane], over few values.
const FEW: [&str; 6] = [
    "sweep.points=5",
    "sweep.impacts=100",
    "sweep.keep=20",
    r#"map={impacts = 100, x = {over = "d", from = 0.1, to = 0.5, points = 3}, y = {over = "r_b", from = 0.3, to = 0.9, points = 2}}"#,
    "box={d = [0.45, 0.5]}",
    "basins={impacts = 100, phase = {from = 0, to = 6, points = 3}, velocity = {from = 0, to = 1, points = 2}}",
];

/// What a command models over [`FEW`], all of its rows made; files go to a directory that is removed.
fn of(command: &[&str], sets: &[&str]) -> Modelled {
    static RUNS: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
    let run = RUNS.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    let scratch = std::env::temp_dir().join(format!("vibro-audit-modelled-{}-{run}", std::process::id()));
    let mut arguments = vec!["vibro-audit", command[0], "fig03"];
    arguments.extend(&command[1..]);
    for set in FEW.iter().chain(sets) {
        arguments.extend(["--set", set]);
    }
    if command == ["run"] {
        arguments.extend(["--out", scratch.to_str().unwrap()]);
    }
    let line = Line::try_parse_from(arguments).unwrap();
    let found = modelled(|| {
        let answer = line.answer().unwrap();
        if let Content::Rows(rows) = answer.content {
            rows.table().unwrap();
        }
    });
    let _ = std::fs::remove_dir_all(&scratch);
    found
}

/// What the motion of each want needs; whatever else is counted is modelled for nobody.
fn needed(want: Want) -> &'static [Call] {
    match want {
        // DP and a proof of every orbit and of every bifurcation
        Want::Orbits | Want::Branch => &[Call::Jacobian, Call::Certificate],
        // how many digits hold, and with them the number
        Want::Impacts => &[Call::Step, Call::Growth],
        // the summary has digits and the exponent, by DP
        Want::Sweep => &[Call::Step, Call::Growth, Call::Exponent, Call::Jacobian],
        Want::Trajectory => &[Call::Step, Call::Growth, Call::Snapshot],
        // with every want of a map
        Want::Voltage | Want::Map => &[
            Call::Step,
            Call::Growth,
            Call::Exponent,
            Call::Jacobian,
            Call::Membrane,
            Call::Deflection,
        ],
        // with a proof of each cycle, and no voltage unless it is wanted
        Want::Basins => &[Call::Step, Call::Jacobian, Call::Certificate],
        // no motion is simulated: the one of the best device is proved
        Want::Optimum => &[Call::Jacobian, Call::Certificate, Call::Membrane, Call::Deflection],
    }
}

/// Every command on a scene with what it may model.
fn commands() -> [(&'static [&'static str], &'static [Call]); 6] {
    [
        (&["orbits"], needed(Want::Orbits)),
        (&["branch"], needed(Want::Branch)),
        (&["simulate"], needed(Want::Impacts)),
        // the diagram has no digits and no exponent
        (&["sweep"], &[Call::Step]),
        (&["sweep", "--summary"], needed(Want::Sweep)),
        (&["trajectory"], needed(Want::Trajectory)),
    ]
}

fn assert_modelled(found: &Modelled, allowed: &[Call], of: &str) {
    for call in Call::ALL {
        let count = found.count(call);
        assert_eq!(count > 0, allowed.contains(&call), "{of}: {call:?} {count} times");
    }
}

#[test]
fn a_command_models_what_it_tells_and_nothing_else() {
    for (command, allowed) in commands() {
        assert_modelled(&of(command, &[WITHOUT]), allowed, command[0]);
    }
}

#[test]
fn a_want_has_modelled_what_it_needs_and_nothing_else() {
    for want in Want::ALL {
        let wanted = format!("want=[\"{}\"]", want.name());
        assert_modelled(&of(&["run"], &[&wanted]), needed(want), &wanted);
    }
}

#[test]
fn where_no_voltage_is_wanted_no_membrane_is_made_or_pressed_in() {
    let commands: [&[&str]; 8] = [
        &["run"],
        &["orbits"],
        &["branch"],
        &["simulate"],
        &["sweep"],
        &["sweep", "--summary"],
        &["trajectory"],
        &["plot"],
    ];
    for command in commands {
        let found = of(command, &[WITHOUT]);
        assert_eq!(
            [Call::Membrane, Call::Deflection].map(|call| found.count(call)),
            [0, 0],
            "{command:?}"
        );
    }
    // nor where voltage is wanted, by commands that do not tell it
    for command in [&["orbits"][..], &["branch"], &["simulate"], &["trajectory"]] {
        let found = of(command, &[WITH]);
        assert_eq!(
            [Call::Membrane, Call::Deflection].map(|call| found.count(call)),
            [0, 0],
            "{command:?}"
        );
    }
}

#[test]
fn where_voltage_is_wanted_the_membrane_is_pressed_in_once_for_each_impact_that_is_listed() {
    let listed = of(&["sweep"], &[WITH]);
    // made to be checked, and to be used
    assert_eq!(
        (listed.count(Call::Membrane) > 0, listed.count(Call::Deflection)),
        (true, 5 * 20)
    );
    for command in [&["run"][..], &["sweep", "--summary"], &["plot"]] {
        let found = of(command, &[WITH]);
        assert!(
            found.count(Call::Membrane) > 0 && found.count(Call::Deflection) > 0,
            "{command:?}: {found:?}"
        );
    }
    // the motion is the same work either way
    assert_eq!(of(&["sweep"], &[WITHOUT]).count(Call::Step), listed.count(Call::Step));
}

#[test]
fn a_sweep_takes_the_steps_of_the_bare_loop_and_follows_no_errors() {
    let swept = of(&["sweep"], &[WITHOUT]);
    let mut scene = Scene::read(crate::scene::find("fig03").unwrap(), "fig03").unwrap();
    for set in FEW {
        scene.set(set).unwrap();
    }
    let (sweep, setting, start) = (scene.sweep(), scene.swept_setting(), scene.start());
    let (sweep, setting, start) = (sweep.unwrap(), setting.unwrap(), start.unwrap());
    let bare = modelled(|| {
        for value in sweep.values() {
            let motion = crate::model::Parameters::motion::<f64>(&setting.fixed(&value)).unwrap();
            let impacts = Simulation::new(&motion, &start.start()).filter(|event| event.kind == Kind::Impact);
            assert_eq!(impacts.take(100).count(), 100);
        }
    });
    assert!(bare.count(Call::Step) >= 5 * 100 && bare.count(Call::Growth) == 0);
    assert_eq!(swept, bare);
    // what is told of a summary costs more: errors are followed, and cycles until they repeat
    let summary = of(&["sweep", "--summary"], &[WITHOUT]);
    assert!(
        summary.count(Call::Step) > bare.count(Call::Step) && summary.count(Call::Growth) >= bare.count(Call::Step),
        "{summary:?}"
    );
}
