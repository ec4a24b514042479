//! `vibro-audit run SCENE [--explain] --out DIR`.

use super::options::create_directory;
use super::{
    Answer, Content, Exit, Failure, Options, SceneArguments, basins, branch, map, optimise, orbits, plot, simulate,
    sweep, trajectory,
};
use crate::report::plot::Figure;
use crate::report::{Cell, Format, Output, OutputError, OutputProblem, Page, Part, Table};
use crate::scene::{Scene, Want};
use std::fs;
use std::path::Path;

/// Run every command that a scene asks for; --out names the directory of the results
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit run fig02 --out results")]
pub struct Arguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Compute nothing; list the commands that would run, the model of each and why
    #[arg(long)]
    pub explain: bool,
}

/// What a command has to say of a scene.
type Serve = fn(&Scene, &Options) -> Result<Content, Failure>;

/// A file that serves a want.
struct Served {
    /// The command of the want.
    command: &'static str,
    /// The name of the file, without its extension.
    file: &'static str,
    serve: Serve,
}

/// The files that serve wants; a want whose command is not here has none yet.
const SERVED: &[Served] = &[
    Served {
        command: "orbits",
        file: "orbits",
        serve: |scene, options| orbits::table(scene, options).map(Content::Table),
    },
    Served {
        command: "branch",
        file: "branch",
        serve: |scene, options| branch::rows(scene, options).map(Content::Rows),
    },
    Served {
        command: "simulate",
        file: "simulate",
        serve: |scene, options| simulate::table(scene, options).map(Content::Table),
    },
    Served {
        command: "sweep",
        file: "sweep",
        serve: |scene, options| sweep::impact_rows(scene, options).map(Content::Rows),
    },
    Served {
        command: "sweep",
        file: "summary",
        serve: |scene, options| sweep::summary_rows(scene, options).map(Content::Rows),
    },
    Served {
        command: "map",
        file: "map",
        serve: |scene, options| map::rows(scene, options).map(Content::Rows),
    },
    Served {
        command: "basins",
        file: "basins",
        serve: |scene, options| basins::rows(scene, options).map(Content::Rows),
    },
    Served {
        command: "optimise",
        file: "optimise",
        serve: |scene, _| optimise::table(scene).map(Content::Table),
    },
    Served {
        command: "trajectory",
        file: "trajectory",
        serve: |scene, options| trajectory::table(scene, options).map(Content::Table),
    },
];

/// The columns that scripts rely on.
const COLUMNS: [&str; 4] = ["command", "want", "file", "rows"];

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load()?;
    let wants = scene.wanted()?;
    arguments.scene.check(&scene, &wants)?;
    if arguments.explain {
        let text = scene.explain(&wants, |want| files(SERVED, want).next().is_some())?;
        return Ok(Answer {
            content: Content::Text(text),
            exit: Exit::AsExpected,
        });
    }
    let figure = match options.format {
        Format::Html => plot::of(&scene)?,
        _ => None,
    };
    let mut answer = run_with(SERVED, &scene, &wants, options)?;
    if let (Format::Html, Some(directory), Content::Table(files)) = (options.format, &options.out, &mut answer.content)
    {
        let path = directory.join("report.html");
        let page = page(&scene, files, figure)?;
        let rows = i64::try_from(page.rows()).unwrap_or(i64::MAX);
        Output::Member(path.clone()).write(|to| page.write(to, options.figures()))?;
        files.push(
            ["run", "", &path.display().to_string()]
                .map(Cell::from)
                .into_iter()
                .chain([Cell::from(rows)])
                .collect::<Vec<_>>(),
        )?;
    }
    Ok(answer)
}

/// The rows of a file that a page shows.
const MOST_SHOWN: usize = 200;

/// The figure of the scene, and the beginning of each file.
fn page(scene: &Scene, files: &Table, figure: Option<Figure>) -> Result<Page, Failure> {
    let mut parts: Vec<Part> = figure.into_iter().map(Part::Figure).collect();
    for row in files.rows() {
        let [command, _, file, rows] =
            [0, 1, 2, 3].map(|place| row.get(place).map(|cell| cell.plain().into_owned()).unwrap_or_default());
        let said = match rows.parse::<usize>() {
            Ok(rows) if rows > MOST_SHOWN => format!("The first {MOST_SHOWN} of {rows} rows; all are in {file}."),
            _ => format!("Also in {file}."),
        };
        parts.push(Part::Table(command, said, beginning(Path::new(&file))?));
    }
    Ok(Page {
        title: scene.title()?.unwrap_or(scene.name()).to_owned(),
        notes: vec![format!("Scene {}.", scene.name())],
        parts,
    })
}

/// The first rows of a file that was written.
fn beginning(path: &Path) -> Result<Table, Failure> {
    let unread = |source: std::io::Error| OutputError {
        place: path.display().to_string(),
        problem: OutputProblem::System {
            doing: "reading what was written",
            source,
        },
    };
    let file = fs::File::open(path).map_err(unread)?;
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(file);
    let head = reader.headers().map_err(|error| unread(error.into()))?;
    let (mut table, columns) = (Table::new(head.iter()), head.len());
    for row in reader.into_records().take(MOST_SHOWN) {
        let row = row.map_err(|error| unread(error.into()))?;
        // a table of other columns follows
        if row.len() != columns {
            break;
        }
        let cell = |text: &str| match text.parse::<f64>() {
            _ if text.is_empty() => Cell::Empty,
            Ok(number) if Cell::from(number).plain() == text => Cell::from(number),
            _ => Cell::from(text),
        };
        table.push(row.iter().map(cell).collect::<Vec<_>>())?;
    }
    Ok(table)
}

fn files(served: &[Served], want: Want) -> impl Iterator<Item = &Served> {
    served.iter().filter(move |file| file.command == want.command())
}

/// Writes the files of each served want, and fails for the others afterwards.
fn run_with(served: &[Served], scene: &Scene, wants: &[Want], options: &Options) -> Result<Answer, Failure> {
    let unserved: Vec<Want> = wants
        .iter()
        .copied()
        .filter(|&want| files(served, want).next().is_none())
        .collect();
    let mut answer = Table::new(COLUMNS);
    let mut written = Vec::new();
    let mut done: Vec<&str> = Vec::new();
    for &want in wants {
        // Voltage is a column of the sweep: the same files serve both.
        if done.contains(&want.command()) {
            continue;
        }
        done.push(want.command());
        let same = wants.iter().filter(|other| other.command() == want.command());
        let same = same.map(|want| want.name()).collect::<Vec<_>>().join(";");
        for Served { file, serve, .. } in files(served, want) {
            let directory = options.out.as_deref().ok_or(Failure::NoDirectory)?;
            let content = serve(scene, options)?;
            create_directory(directory)?;
            let (format, extension) = match options.format {
                Format::Text
                | Format::Csv
                | Format::Junit
                | Format::Html
                | Format::Sarif
                | Format::Sympy
                | Format::Rocq => (Format::Csv, "csv"),
                Format::Json => (Format::Json, "json"),
                Format::Jsonl => (Format::Jsonl, "jsonl"),
                Format::Markdown => (Format::Markdown, "md"),
            };
            let path = directory.join(format!("{file}.{extension}"));
            let (rows, _) = content.write(&Output::Member(path.clone()), format, options.figures())?;
            answer.push([
                Cell::from(want.command()),
                Cell::from(same.as_str()),
                Cell::from(path.display().to_string()),
                Cell::from(i64::try_from(rows).unwrap_or(i64::MAX)),
            ])?;
            written.push(path.display().to_string());
        }
    }
    if !unserved.is_empty() {
        return Err(Failure::Unserved {
            wants: unserved,
            written,
        });
    }
    Ok(Answer {
        content: Content::Table(answer),
        exit: Exit::AsExpected,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::DEFAULT_DIGITS;

    fn one_row(scene: &Scene, _: &Options) -> Result<Content, Failure> {
        let mut table = Table::new(["name"]);
        table.push([Cell::from(scene.name())])?;
        Ok(Content::Table(table))
    }

    fn file(command: &'static str, file: &'static str, serve: Serve) -> Served {
        Served { command, file, serve }
    }

    fn broken(scene: &Scene, _: &Options) -> Result<Content, Failure> {
        scene.motion::<f64>()?;
        one_row(scene, &options(None))
    }

    fn options(out: Option<&Path>) -> Options {
        Options {
            format: Format::Text,
            out: out.map(Path::to_path_buf),
            digits: u32::try_from(DEFAULT_DIGITS).ok(),
        }
    }

    fn scratch(name: &str) -> std::path::PathBuf {
        let path = std::env::temp_dir().join(format!("vibro-audit-run-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        path
    }

    #[test]
    fn each_command_writes_its_files_once_and_what_none_serves_is_named_after() {
        let scene = Scene::read("", "mine").unwrap();
        let directory = scratch("files");
        let served = &[
            file("orbits", "orbits", one_row),
            file("sweep", "sweep", one_row),
            file("sweep", "summary", one_row),
        ];
        let options = options(Some(&directory));
        let wants = [Want::Orbits, Want::Sweep, Want::Voltage];
        let answer = run_with(served, &scene, &wants, &options).unwrap();
        assert!(matches!(&answer.content, Content::Table(table) if table.rows().len() == 3));
        assert_eq!(
            fs::read_to_string(directory.join("orbits.csv")).unwrap(),
            "name\nmine\n"
        );
        let error = run_with(served, &scene, &Want::ALL, &options).unwrap_err().to_string();
        assert!(
            error.contains("branch, impacts, trajectory") && error.contains("sweep.csv"),
            "{error}"
        );
        assert_eq!(fs::read_dir(&directory).unwrap().count(), 3);
        fs::remove_dir_all(&directory).unwrap();
    }

    #[test]
    fn where_nothing_can_be_computed_no_directory_is_made() {
        let scene = Scene::read("", "mine").unwrap();
        let directory = scratch("none");
        let served = &[file("orbits", "orbits", broken)];
        assert!(run_with(served, &scene, &[Want::Orbits], &options(Some(&directory))).is_err());
        assert!(!directory.exists());
        let error = run_with(served, &scene, &[Want::Orbits], &options(None)).unwrap_err();
        assert!(error.to_string().contains("--out DIR"), "{error}");
    }
}
