//! `vibro-audit plot SCENE` and `vibro-audit plot all --out DIR`.

mod claims;
mod curves;
mod map;
mod motion;
mod optimum;
mod paper;
mod swept;

use super::answer::Copied;
use super::{Answer, Content, Exit, Failure, Options, SceneArguments};
use crate::report::plot::{Figure, Panel};
use crate::report::{Cell, Output, Table};
use crate::scene::{Scene, Want};
use claims::Claims;
use rayon::prelude::*;
use std::path::Path;

/// Draw a scene as SVG or PNG; `plot all --out DIR` draws every figure of the paper
///
/// What is drawn depends on `want` in the scene:
///   branch, sweep   a bifurcation diagram
///   voltage         an energy diagram beside it; without it the phases of the impacts stand there
///   trajectory      a phase portrait, and position against time
///   map             a map in colours for each quantity in map.want
///   basins          each start in the colour of its attractor
///   optimum         the best device, and the voltage of those around it
///   branch over two parameters: the curves, on top of a map of the same two if that is wanted too
/// On the paper's own figures a ring marks a printed value that is reproduced, and a cross one that is wrong.
#[derive(Debug, clap::Args)]
#[command(verbatim_doc_comment)]
#[command(after_help = "Example: vibro-audit plot fig03 --out fig03.svg")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Draw for one column of a page, 8.5 cm wide: panels stand below each other
    #[arg(long)]
    narrow: bool,
    /// With `all`, write a PNG beside each SVG; a single figure is a PNG where --out ends in .png
    #[arg(long)]
    png: bool,
}

/// The word that stands for every figure of the paper; a file of this name is `./all`.
const ALL: &str = "all";

/// The extensions of images that are neither SVG nor PNG.
const OTHER_IMAGES: [&str; 7] = ["pdf", "jpg", "jpeg", "gif", "eps", "ps", "webp"];

/// The pixels of a panel whose text is of 7 points or more where it is 8.5 cm wide.
const NARROW: (f64, f64) = (420.0, 320.0);

/// The columns that scripts rely on.
const COLUMNS: [&str; 3] = ["figure", "file", "bytes"];

impl Arguments {
    /// Whether every figure of the paper is meant.
    pub fn is_all(&self) -> bool {
        self.scene.name() == ALL
    }

    /// The figure in the size that is asked for.
    fn sized(&self, figure: Figure) -> Figure {
        match self.narrow {
            true => Figure {
                columns: 1,
                panel_size: NARROW,
                ..figure
            },
            false => figure,
        }
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let extension = options.out.as_deref().and_then(Path::extension);
    let is_other = |known: &str| extension.is_some_and(|own| own.eq_ignore_ascii_case(known));
    if let Some(other) = OTHER_IMAGES.into_iter().find(|known| is_other(known)) {
        return Err(Failure::Usage(format!(
            "plot writes SVG and PNG, not {}: name a file that ends in .svg, and convert it",
            other.to_uppercase()
        )));
    }
    let claims = Claims::read()?;
    let content = if arguments.is_all() {
        let directory = options.out.as_deref().ok_or(Failure::NoFigures)?;
        Content::Table(all(arguments, directory, &claims)?)
    } else {
        let scene = arguments.scene.load()?;
        arguments.scene.check(&scene, &scene.wanted()?)?;
        let figure = if paper::is_comparison(&scene) {
            paper::comparison(&scene, &paper::swept(&scenes(arguments)?)?, &claims)?
        } else {
            one(&scene, swept(&scene)?.as_ref(), &claims)?
        };
        let figure = arguments.sized(figure);
        match extension {
            Some(_) => {
                let bytes = figure.bytes(options.out.as_deref())?;
                Content::Copied(Copied(Box::new(move |to| to.write_all(&bytes).map(|()| 0))))
            }
            None => Content::Text(figure.svg()?),
        }
    };
    Ok(Answer {
        content,
        exit: Exit::AsExpected,
    })
}

/// The figure of a scene, as far as what it wants can be drawn.
///
/// # Errors
/// What cannot be computed.
pub(super) fn of(scene: &Scene) -> Result<Option<Figure>, Failure> {
    match one(scene, swept(scene)?.as_ref(), &Claims::read()?) {
        Ok(figure) => Ok(Some(figure)),
        Err(Failure::NothingDrawn(_)) => Ok(None),
        Err(failure) => Err(failure),
    }
}

/// Every figure of the paper; files are written once all are drawn.
fn all(arguments: &Arguments, directory: &Path, claims: &Claims) -> Result<Table, Failure> {
    let scenes = scenes(arguments)?;
    super::options::create_directory(directory)?;
    let swept = paper::swept(&scenes)?;
    let drawn: Result<Vec<(&str, Figure)>, Failure> = scenes
        .par_iter()
        .map(|scene| {
            let figure = if paper::is_comparison(scene) {
                paper::comparison(scene, &swept, claims)?
            } else {
                one(scene, paper::of(&swept, scene), claims)?
            };
            Ok((scene.name(), arguments.sized(figure)))
        })
        .collect();
    let mut table = Table::new(COLUMNS);
    let extensions = if arguments.png { &["svg", "png"][..] } else { &["svg"] };
    for (name, figure) in drawn? {
        for extension in extensions {
            let path = directory.join(format!("{name}.{extension}"));
            let bytes = figure.bytes(Some(&path))?;
            Output::Member(path.clone()).write(|to| to.write_all(&bytes))?;
            table.push([
                Cell::from(name),
                Cell::from(path.display().to_string()),
                Cell::from(i64::try_from(bytes.len()).unwrap_or(i64::MAX)),
            ])?;
        }
    }
    Ok(table)
}

/// The scenes of the paper, with the overrides.
fn scenes(arguments: &Arguments) -> Result<Vec<Scene>, Failure> {
    paper::scenes(|scene| {
        arguments.scene.apply(scene)?;
        arguments.scene.check(scene, &scene.wanted()?)
    })
}

/// What a sweep of the scene shows, where it wants one.
fn swept(scene: &Scene) -> Result<Option<swept::Swept>, Failure> {
    let wants = scene.want()?;
    let is_swept = wants.iter().any(|want| {
        matches!(want, Want::Sweep | Want::Voltage) || (*want == Want::Branch && !scene.branches_over_two())
    });
    is_swept.then(|| swept::Swept::new(scene)).transpose()
}

/// The figure of one scene: all its panels.
fn one(scene: &Scene, swept: Option<&swept::Swept>, claims: &Claims) -> Result<Figure, Failure> {
    let mut panels: Vec<Panel> = Vec::new();
    if let Some(swept) = swept {
        panels.extend(swept.panels(scene, claims)?);
    }
    if scene.want()?.contains(&Want::Trajectory) {
        panels.extend(motion::panels(scene, claims)?);
    }
    let curves = curves::of(scene)?;
    let mut is_drawn = false;
    if scene.want()?.contains(&Want::Map) {
        let over = scene.map().map(|map| [map.x.over, map.y.over])?;
        let over = curves.as_ref().map_or(Vec::new(), |curves| curves.over(over));
        is_drawn = !over.is_empty();
        for mut panel in map::panels(scene)? {
            panel.series.extend(over.iter().cloned());
            panels.push(panel);
        }
    }
    panels.extend(curves.filter(|_| !is_drawn).map(|curves| curves.panel()));
    if scene.want()?.contains(&Want::Basins) {
        panels.extend(map::basins(scene)?);
    }
    if scene.want()?.contains(&Want::Optimum) {
        panels.extend(optimum::panels(scene)?);
    }
    if panels.is_empty() {
        return Err(Failure::NothingDrawn(scene.name().to_owned()));
    }
    let title = scene.title()?.unwrap_or_default();
    Ok(Figure {
        columns: 2,
        ..Figure::new(title, panels)
    })
}
