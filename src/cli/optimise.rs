//! `vibro-audit optimise SCENE [--gap G] [--effort N] [--resume]`.

use super::complete::Complete;
use super::progress::Progress;
use super::resume::{RECORD, Unfinished};
use super::rows::Rows;
use super::shard::{Label, Shard};
use super::{Answer, Content, Exit, Failure, Options, SceneArguments, note};
use crate::number::Interval;
use crate::orbit::{
    Active, Optimum, OptimumLimits, OptimumPart, OptimumProgress, ProvedWordDevice, SearchRecord, Word, local_optimum,
    optimum_recorded,
};
use crate::report::{Cell, Table};
use crate::scene::{BoxChoice, LocalChoice, Over, Scene, Want};

/// Find the device with the largest voltage in a box of parameters, with proof
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example: vibro-audit optimise fig03 --set 'box={d = [0.1, 0.5], r_b = [0.3, 0.7], r_t = [0.3, 0.7]}'"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Stop when the maximum is proved to be within this fraction of its upper bound
    #[arg(long, value_name = "PART", default_value_t = GAP, value_parser = gap)]
    gap: f64,
    /// Search up to N times as many boxes
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=MOST_EFFORT))]
    effort: u64,
    /// Search only part I of N, as CSV; `merge` joins the parts
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Go on with an interrupted run: its rows are in FILE.part beside --out FILE
    #[arg(long)]
    resume: bool,
    #[command(flatten)]
    complete: Complete,
}

/// The usual gap.
const GAP: f64 = 1e-4;

/// The usual limit in boxes: seconds.
const BOXES: u64 = 500_000;

/// The usual limits.
const USUAL: OptimumLimits = OptimumLimits {
    gap: GAP,
    most_boxes: BOXES,
    part: OptimumPart::WHOLE,
};

/// The largest `--effort`: a box takes some hundred bytes.
const MOST_EFFORT: u64 = 1000;

/// The columns that scripts rely on.
const COLUMNS: [&str; 11] = [
    "quantity",
    "low",
    "high",
    "value",
    "attained",
    "active",
    "sensitivity",
    "gap",
    "boxes",
    "complete",
    "error_bound",
];

fn gap(text: &str) -> Result<f64, String> {
    let gap = text.parse::<f64>().ok().filter(|gap| *gap > 0.0 && *gap < 1.0);
    gap.ok_or_else(|| "a number above 0 and below 1, as in 1e-3".to_owned())
}

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Optimum])?;
    let shard = arguments.shard;
    let limits = OptimumLimits {
        gap: arguments.gap,
        most_boxes: BOXES * arguments.effort,
        part: shard.map_or(OptimumPart::WHOLE, Shard::part),
    };
    let label = |shard| {
        let label = Label::new(shard, COMMAND, &scene, &[Want::Optimum])?;
        let run = format!("{} gap {} effort {}", label.run, arguments.gap, arguments.effort);
        Ok::<_, Failure>(Label { run, ..label })
    };
    let part = shard.map(label).transpose()?;
    let unfinished = arguments.resume.then(|| {
        let label = label(shard.unwrap_or(Shard::WHOLE))?;
        Unfinished::open(options, shard, label, &RECORD)
    });
    let asked = scene.choice()?;
    if asked.local.is_some() {
        if arguments.shard.is_some() || arguments.resume {
            let usage = "--shard and --resume are of the proved search, for BT under one cosine; leave them out";
            return Err(Failure::Usage(usage.to_owned()));
        }
        return Ok(arguments.complete.answer(table(&scene)?));
    }
    let Some(unfinished) = unfinished.transpose()? else {
        let Ok(found) = search(&asked, limits, &mut ());
        let table = table_of(&asked, &found, limits)?;
        return Ok(arguments.complete.answer(Rows::from(table).part(part)));
    };
    let mut record = unfinished.record()?;
    let found = search(&asked, limits, &mut record)?;
    record.end()?;
    let rows = Rows::from(table_of(&asked, &found, limits)?).part(part);
    Ok(Answer {
        content: Content::Recorded(unfinished, arguments.complete.required(rows)),
        exit: Exit::AsExpected,
    })
}

/// The name of the command, which its parts say.
pub(super) const COMMAND: &str = "optimise";

/// The table of all parts of a search, each as its rows: the largest value that is proved, no more than the largest bound of
/// all, at a place that is in the hull of theirs. `None` where they are not such rows.
pub(super) fn joined(parts: &[Vec<Vec<String>>]) -> Option<Table> {
    let mut table = Table::new(COLUMNS);
    // a part without rows holds no motion as asked
    let parts: Vec<&Vec<Vec<String>>> = parts.iter().filter(|rows| !rows.is_empty()).collect();
    let number = |part: &Vec<Vec<String>>, row: usize, column: usize| part.get(row)?.get(column)?.parse::<f64>().ok();
    let of = |row: usize, column: usize| parts.iter().filter_map(move |part| number(part, row, column));
    let least = |row, column| of(row, column).reduce(f64::min);
    let largest = |row, column| of(row, column).reduce(f64::max);
    let value = |part: &&&Vec<Vec<String>>| number(part, 0, 1).unwrap_or(f64::NEG_INFINITY);
    let Some(best) = parts.iter().max_by(|one, other| value(one).total_cmp(&value(other))) else {
        return Some(table);
    };
    let text = |row: usize, column: usize| Some(Cell::from(best.get(row)?.get(column)?.as_str()));
    let all = |column: usize, word: &str| {
        parts
            .iter()
            .all(|part| part[0].get(column).is_some_and(|cell| cell == word))
    };
    // bounds that are not told are none
    let is_bounded = parts.iter().all(|part| number(part, 0, 2).is_some());
    let most = largest(0, 2).filter(|_| is_bounded);
    let (low, rate) = (number(best, 0, 1), number(best, 0, 3));
    let reached = most.and_then(|most| {
        let (boxes, best) = (0, low);
        OptimumProgress { boxes, best, most }.gap()
    });
    // what one part says holds of all, where those that say something else have no motion that is worth as much
    let says = |word: &str| {
        let is_said = |part: &&&Vec<Vec<String>>| part[0].get(4).is_some_and(|cell| cell == word);
        parts.iter().filter(is_said).any(|one| {
            let mut others = parts.iter().filter(|part| !is_said(part));
            others.all(|part| matches!((number(part, 0, 2), number(one, 0, 1)), (Some(most), Some(low)) if most < low))
        })
    };
    let attained = match (says("true"), says("false")) {
        (true, _) => Cell::from(true),
        (_, true) => Cell::from(false),
        _ => Cell::Empty,
    };
    let boxes: f64 = of(0, 8).sum();
    table
        .push(vec![
            text(0, 0)?,
            Cell::from(low),
            Cell::from(most),
            Cell::from(rate),
            attained,
            text(0, 5)?,
            Cell::Empty,
            Cell::from(reached),
            Cell::from(boxes as i64),
            Cell::from(all(9, "true")),
            Cell::from(
                rate.zip(low)
                    .zip(most)
                    .map(|((rate, low), most)| farthest(rate, [low, most])),
            ),
        ])
        .ok()?;
    for row in 1..best.len() {
        if parts
            .iter()
            .any(|part| part.get(row).map(|row| &row[0]) != Some(&best[row][0]))
        {
            return None;
        }
        let (low, high, value) = (least(row, 1), largest(row, 2), number(best, row, 3));
        let bound = value
            .zip(low.zip(high))
            .map(|(value, (low, high))| farthest(value, [low, high]));
        table
            .push(vec![
                text(row, 0)?,
                Cell::from(low),
                Cell::from(high),
                Cell::from(value),
                Cell::Empty,
                text(row, 5)?,
                Cell::from(number(best, row, 6)),
                Cell::Empty,
                Cell::Empty,
                Cell::Empty,
                Cell::from(bound),
            ])
            .ok()?;
    }
    Some(table)
}

/// The table of a scene, to the usual gap.
///
/// # Errors
/// As [`Scene::choice`].
pub fn table(scene: &Scene) -> Result<Table, Failure> {
    let asked = scene.choice()?;
    match &asked.local {
        Some(local) => local_table(&asked, local),
        None => table_of(&asked, &usual(&asked), USUAL),
    }
}

/// The best device that local searches find for words, or under a forcing, of which it is not proved that all were seen: a
/// row of the voltage, without an upper bound, and one for each parameter.
fn local_table(asked: &BoxChoice, local: &LocalChoice) -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS);
    let mut best: Option<(&Word, ProvedWordDevice)> = None;
    for word in &local.words {
        let found = local_optimum(&asked.choice, &local.base, word)?;
        let is_better = |device: &ProvedWordDevice| {
            let known = best.as_ref().map(|(_, known)| known.rate.midpoint());
            known.is_none_or(|known| device.rate.midpoint() > known)
        };
        if let Some(device) = found.filter(is_better) {
            best = Some((word, device));
        }
    }
    let Some((word, device)) = best else {
        note("local searches found no such motion, which proves nothing");
        return Ok(table);
    };
    note(&format!(
        "the best device that local searches find, with a motion {word} that is proved; there may be better ones"
    ));
    // where the best of all lies is not known: nothing is low or high but the voltage of this one
    let row = |name: &str, low: Cell, value: &Interval| {
        let mut row = vec![Cell::from(name), low, Cell::Empty, Cell::from(value.midpoint())];
        row.resize(COLUMNS.len(), Cell::Empty);
        row
    };
    let mut objective = row("voltage_rate", Cell::from(device.rate.low()), &device.rate);
    objective[COLUMNS.len() - 2] = Cell::from(false);
    table.push(objective)?;
    for (over, value) in asked.parameters.iter().zip(&device.parameters) {
        table.push(row(over.name(), Cell::Empty, value))?;
    }
    Ok(table)
}

/// The best device, to the usual gap.
pub(super) fn usual(asked: &BoxChoice) -> Optimum {
    let Ok(found) = search(asked, USUAL, &mut ());
    found
}

/// The search, which shows how far it is.
fn search<R: SearchRecord>(asked: &BoxChoice, limits: OptimumLimits, record: &mut R) -> Result<Optimum, R::Error> {
    let status = Progress::line();
    let show = |progress: &OptimumProgress| status.show(|| line(progress));
    optimum_recorded(&asked.choice, limits, record, show)
}

fn table_of(asked: &BoxChoice, found: &Optimum, limits: OptimumLimits) -> Result<Table, Failure> {
    say(asked, found, limits);
    let mut table = Table::new(COLUMNS);
    if found.is_complete && found.device.is_none() {
        return Ok(table);
    }
    table.push(objective(asked, found))?;
    for index in 0..asked.parameters.len() {
        table.push(parameter(asked, found, index))?;
    }
    Ok(table)
}

/// `9000 boxes: 124320.6 V, at most 124560.2 V`
fn line(progress: &OptimumProgress) -> String {
    let best = progress
        .best
        .map_or("nothing yet".to_owned(), |best| format!("{best:.1} V"));
    format!("{} boxes: {best}, at most {:.1} V", progress.boxes, progress.most)
}

fn say(asked: &BoxChoice, found: &Optimum, limits: OptimumLimits) {
    if asked.has_other_words {
        note("of the words, BT alone is searched, with proof; `--set words=WORD` looks for devices with another one");
    }
    let periods = asked.choice.max_periods;
    let over = if periods == 1 {
        "one forcing period".to_owned()
    } else {
        format!("1 to {periods} forcing periods")
    };
    if found.is_complete && found.device.is_none() {
        note(&format!(
            "no device of the box has a 1-1 motion over {over} that is stable and keeps off the walls as asked"
        ));
    } else if found.device.is_none() {
        note("no such motion was found, and none excluded; --effort goes farther");
    } else if !found.is_complete {
        note(&format!(
            "the gap of {} was not reached in {} boxes; --effort goes farther",
            limits.gap, found.boxes
        ));
    }
}

/// The row of the voltage.
fn objective(asked: &BoxChoice, found: &Optimum) -> Vec<Cell> {
    let rate = found.device.as_ref().map(|device| device.rate);
    let active: Vec<&str> = found.active.iter().map(|active| name(asked, *active)).collect();
    vec![
        Cell::from("voltage_rate"),
        Cell::from(rate.map(|rate| rate.low())),
        Cell::from(Some(found.most).filter(|most| most.is_finite())),
        Cell::from(rate.map(|rate| rate.midpoint())),
        found.attained.map_or(Cell::Empty, Cell::from),
        Cell::from(active.join(";")),
        Cell::Empty,
        Cell::from(found.gap()),
        Cell::from(i64::try_from(found.boxes).unwrap_or(i64::MAX)),
        Cell::from(found.is_complete),
        Cell::from(rate.map(|rate| farthest(rate.midpoint(), [rate.low(), found.most]))),
    ]
}

/// The row of a parameter.
fn parameter(asked: &BoxChoice, found: &Optimum, index: usize) -> Vec<Cell> {
    let place = found.place.as_ref().map(|place| place[index]);
    let end = |end: fn(&Interval) -> f64| Cell::from(place.as_ref().map(end));
    let value = found.device.as_ref().map(|device| device.parameters[index].midpoint());
    let active = match found.active.iter().find(|active| parameter_of(**active) == Some(index)) {
        _ if asked.choice.ranges[index].is_held() => "held",
        Some(Active::Low(_)) => "low",
        Some(_) => "high",
        None => "",
    };
    let sensitivity = found.sensitivities.map(|all| all[index]);
    vec![
        Cell::from(asked.parameters[index].name()),
        end(Interval::low),
        end(Interval::high),
        Cell::from(value),
        Cell::Empty,
        Cell::from(active),
        Cell::from(sensitivity),
        Cell::Empty,
        Cell::Empty,
        Cell::Empty,
        Cell::from(
            value
                .zip(place)
                .map(|(value, place)| farthest(value, [place.low(), place.high()])),
        ),
    ]
}

/// How far a number between two ends may be from `value`, at most.
fn farthest(value: f64, ends: [f64; 2]) -> f64 {
    let away = ends.map(|end| (end - value).abs().next_up());
    away[0].max(away[1])
}

fn parameter_of(active: Active) -> Option<usize> {
    match active {
        Active::Low(index) | Active::High(index) => Some(index),
        _ => None,
    }
}

fn name(asked: &BoxChoice, active: Active) -> &'static str {
    match active {
        Active::Low(index) | Active::High(index) => asked.parameters.get(index).map_or("", |over: &Over| over.name()),
        Active::Fold => "fold",
        Active::PeriodDoubling => "period-doubling",
        Active::Grazing => "grazing",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What all parts say of `attained`, of which each has its bounds and says this.
    fn told(parts: &[([f64; 2], &str)]) -> Cell {
        let part = |([low, high], attained): &([f64; 2], &str)| {
            let row = format!("voltage_rate,{low},{high},{low},{attained},d,,0,10,true,0");
            vec![row.split(',').map(str::to_owned).collect()]
        };
        let parts: Vec<Vec<Vec<String>>> = parts.iter().map(part).collect();
        joined(&parts).unwrap().rows()[0][4].clone()
    }

    #[test]
    fn the_best_parts_say_whether_the_supremum_is_attained() {
        let (whole, [low, high]) = ([3.0, 3.1], [[1.0, 2.0], [2.0, 3.0]]);
        for (word, other) in [("true", "false"), ("false", "true")] {
            let said = Cell::from(word == "true");
            assert_eq!(told(&[(whole, word)]), said);
            assert_eq!(told(&[(whole, word), (whole, word)]), said);
            for lesser in [other, ""] {
                assert_eq!(told(&[(low, lesser), (whole, word)]), said);
                // it may have one that is worth as much
                assert_eq!(told(&[(whole, word), (high, lesser)]), Cell::Empty);
            }
            assert_eq!(told(&[(whole, ""), (low, word)]), Cell::Empty);
        }
    }

    #[test]
    fn a_gap_is_a_part() {
        assert_eq!(gap("1e-3"), Ok(1e-3));
        for text in ["0", "1", "-1", "NaN", "inf", "small", ""] {
            assert!(gap(text).is_err(), "{text}");
        }
    }
}
