//! Pictures of a sweep's table: what is collected over what is varied, and all of it as parallel coordinates.

use kuva::plot::parallel::ParallelPlot;
use kuva::plot::scatter::ScatterPlot;
use kuva::render::figure::Figure as Panels;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};
use kuva::render::theme::Theme;

use super::FigureError;
use super::plot::COLOURS;
use super::render;

/// Most members that are drawn, evenly chosen.
const MOST_MEMBERS: usize = 2000;
/// Most panels side by side, and one above the other.
const MOST_PANELS: usize = 6;
/// Size of a panel and of the parallel coordinates [pixels].
const PANEL: (f64, f64) = (340.0, 260.0);
const PARALLEL: (f64, f64) = (220.0, 460.0);

/// A column of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepAxis {
    /// Its name.
    pub name: String,
    /// Its value in each member; of words, their number among those that occur.
    pub values: Vec<f64>,
    /// Whether even ratios are evenly far apart.
    pub is_logarithmic: bool,
}

impl SweepAxis {
    /// A column of words, which are numbered as they come.
    pub fn of_words(name: &str, words: &[String]) -> Self {
        let mut known: Vec<&String> = Vec::new();
        let mut number = |word| {
            let found = known.iter().position(|own| *own == word);
            found.unwrap_or_else(|| {
                known.push(word);
                known.len() - 1
            })
        };
        let values = words.iter().map(|word| number(word) as f64).collect();
        let few = known.iter().take(4).enumerate().map(|(k, word)| format!("{k} {word}"));
        let more = if known.len() > 4 { ", …" } else { "" };
        let name = format!("{name} ({}{more})", few.collect::<Vec<_>>().join(", "));
        Self { name, values, is_logarithmic: false }
    }
}

/// The solved members of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPlot {
    /// Above the drawings.
    pub title: String,
    /// What is varied.
    pub varied: Vec<SweepAxis>,
    /// What is collected.
    pub collected: Vec<SweepAxis>,
}

impl SweepPlot {
    /// What is collected, row by row, over what is varied, column by column. Of many, the first six each.
    ///
    /// # Errors
    /// If there are no members to draw.
    pub fn responses(&self) -> Result<SweepPicture, FigureError> {
        let members = self.members("responses")?;
        let collected = &self.collected[..self.collected.len().min(MOST_PANELS)];
        let varied = &self.varied[..self.varied.len().min(MOST_PANELS)];
        let (mut plots, mut layouts) = (Vec::new(), Vec::new());
        for (index, above) in collected.iter().enumerate() {
            for below in varied {
                let points: Vec<(f64, f64)> =
                    members.iter().map(|&member| (below.values[member], above.values[member])).collect();
                let scatter = ScatterPlot::new()
                    .with_data(points)
                    .with_color(COLOURS[index % COLOURS.len()])
                    .with_size(2.5);
                let own = vec![Plot::Scatter(scatter)];
                let mut layout = Layout::auto_from_plots(&own)
                    .with_theme(theme())
                    .with_x_label(below.name.as_str())
                    .with_y_label(above.name.as_str());
                if below.is_logarithmic {
                    layout = layout.with_log_x();
                } else if let Some((low, high)) = room(below, &members) {
                    layout = layout.with_x_axis_min(low).with_x_axis_max(high);
                }
                if let Some((low, high)) = room(above, &members) {
                    layout = layout.with_y_axis_min(low).with_y_axis_max(high);
                }
                plots.push(own);
                layouts.push(layout);
            }
        }
        let figure = Panels::new(collected.len(), varied.len())
            .with_title(self.title_of(&members))
            .with_title_size(16)
            .with_cell_size(PANEL.0, PANEL.1)
            .with_plots(plots)
            .with_layouts(layouts);
        Ok(SweepPicture(figure.render()))
    }

    /// All members as lines across one axis per column.
    ///
    /// # Errors
    /// If there are no members to draw.
    pub fn parallel_coordinates(&self) -> Result<SweepPicture, FigureError> {
        let members = self.members("parallel-coordinates")?;
        let axes: Vec<&SweepAxis> = self.varied.iter().chain(&self.collected).collect();
        let rows =
            members.iter().map(|&member| axes.iter().map(|axis| axis.values[member]).collect::<Vec<f64>>());
        let plot = ParallelPlot::new()
            .with_axis_names(axes.iter().map(|axis| axis.name.as_str()))
            .with_rows(rows)
            .with_color(COLOURS[0])
            .with_opacity((200.0 / members.len() as f64).clamp(0.08, 0.6));
        let plots = vec![Plot::Parallel(plot)];
        let layout = Layout::auto_from_plots(&plots)
            .with_width(PARALLEL.0 * (axes.len() as f64).max(3.0))
            .with_height(PARALLEL.1)
            .with_theme(theme())
            .with_title(self.title_of(&members))
            .with_title_size(16);
        Ok(SweepPicture(render_multiple(plots, layout)))
    }

    /// The members that are drawn.
    fn members(&self, figure: &str) -> Result<Vec<usize>, FigureError> {
        let count =
            self.varied.iter().chain(&self.collected).map(|axis| axis.values.len()).min().unwrap_or(0);
        if count == 0 || self.varied.is_empty() || self.collected.is_empty() {
            return Err(FigureError { figure: figure.to_owned(), reason: "no member is solved".to_owned() });
        }
        let shown = count.min(MOST_MEMBERS);
        Ok((0..shown).map(|k| k * count / shown).collect())
    }

    fn title_of(&self, members: &[usize]) -> String {
        let count = self.varied[0].values.len();
        if members.len() == count {
            format!("{}: {count} members", self.title)
        } else {
            format!("{}: {} of {count} members", self.title, members.len())
        }
    }
}

fn theme() -> Theme {
    Theme { grid_color: "#e4e4e4".into(), legend_border: "none".into(), ..Theme::light() }
}

/// An axis for values that are all the same, which would have no extent otherwise.
fn room(axis: &SweepAxis, members: &[usize]) -> Option<(f64, f64)> {
    let values = members.iter().map(|&member| axis.values[member]);
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let is_constant = high - low <= 1e-12 * high.abs().max(low.abs());
    let room = if high == 0.0 { 1.0 } else { 0.1 * high.abs() };
    is_constant.then_some((low - room, high + room))
}

/// A picture of a sweep.
pub struct SweepPicture(Scene);

impl SweepPicture {
    /// The drawing as an SVG text.
    pub fn svg(&self) -> String {
        render::svg(&self.0)
    }

    /// The drawing as the bytes of a PNG file.
    ///
    /// # Errors
    /// If the drawing library fails.
    pub fn png(self) -> Result<Vec<u8>, FigureError> {
        render::png(self.0).map_err(|reason| FigureError { figure: "sweep".to_owned(), reason })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(name: &str, values: &[f64]) -> SweepAxis {
        SweepAxis { name: name.to_owned(), values: values.to_vec(), is_logarithmic: false }
    }

    #[test]
    fn every_member_is_a_dot_in_every_panel_and_a_line_across_the_axes() {
        let mut plot = SweepPlot {
            title: "Pendulum".to_owned(),
            varied: vec![axis("mass", &[1.0, 2.0, 3.0]), axis("same", &[5.0; 3])],
            collected: vec![axis("swing", &[0.1, 0.4, 0.9])],
        };
        let svg = plot.responses().unwrap().svg();
        assert_eq!(svg.matches("<circle").count(), 6);
        for words in ["Pendulum: 3 members", "mass", "swing"] {
            assert!(svg.contains(words), "{words}");
        }
        let svg = plot.parallel_coordinates().unwrap().svg();
        assert!(svg.contains("swing") && svg.contains("same"));
        assert!(plot.parallel_coordinates().unwrap().png().unwrap().starts_with(b"\x89PNG"));
        for axis in plot.varied.iter_mut().chain(&mut plot.collected) {
            axis.values = (0..5000).map(f64::from).collect();
        }
        assert!(plot.responses().unwrap().svg().contains("2000 of 5000 members"));
        plot.varied[0].values.clear();
        assert!(plot.responses().is_err());
    }

    #[test]
    fn words_are_numbered() {
        let axis = SweepAxis::of_words("scheme", &["hht", "radau-iia", "hht"].map(str::to_owned));
        assert_eq!(axis.values, [0.0, 1.0, 0.0]);
        assert_eq!(axis.name, "scheme (0 hht, 1 radau-iia)");
    }
}
