//! What a figure shows, whoever draws it.

/// Panels in rows, under one title and with one legend.
#[derive(Debug, Clone, Default)]
pub(crate) struct Figure {
    /// Shown above the panels.
    pub(crate) title: String,
    /// Panels from left to right, then down.
    pub(crate) panels: Vec<Panel>,
    /// Panels in a row.
    pub(crate) columns: usize,
}

/// One pair of axes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Panel {
    /// Shown above the axes.
    pub(crate) title: String,
    /// Quantity and unit.
    pub(crate) x: String,
    /// Quantity and unit.
    pub(crate) y: String,
    /// Curves, the later ones above.
    pub(crate) lines: Vec<Line>,
    /// Curves with widths of their own, above the others.
    pub(crate) strokes: Vec<Stroke>,
    /// Points marked by a dot.
    pub(crate) dots: Vec<Dot>,
    /// Points of one kind, above the curves.
    pub(crate) clouds: Vec<Cloud>,
    /// Words beside points, moved off each other.
    pub(crate) labels: Vec<Label>,
    /// Abscissae that are marked by a line from bottom to top.
    pub(crate) marks: Vec<Mark>,
    /// Ordinates that are marked by a line from left to right.
    pub(crate) levels: Vec<Mark>,
    /// Values over both axes, below all else.
    pub(crate) map: Option<Map>,
    /// What stands below the abscissae 1, 2, … where they are no numbers.
    pub(crate) x_names: Vec<String>,
    /// Whether equal ratios have the same length on the x axis.
    pub(crate) x_log: bool,
    /// Whether one unit has the same length on both axes.
    pub(crate) equal_axes: bool,
    /// Whether the x axis goes on beyond the curves.
    pub(crate) is_loose: bool,
    /// Ends of both axes of a view, which has no numbers on the y axis.
    pub(crate) view: Option<[(f64, f64); 2]>,
    /// End of the x axis and distance between its labels, where the reader expects certain ones.
    pub(crate) x_scale: Option<(f64, f64)>,
}

/// A curve through points.
#[derive(Debug, Clone)]
pub(crate) struct Line {
    /// x and y.
    pub(crate) points: Vec<(f64, f64)>,
    /// Its colour, width and dashes.
    pub(crate) style: Style,
    /// Its name in the legend; the same name in several panels stands there once.
    pub(crate) name: String,
}

/// A curve whose width says something.
#[derive(Debug, Clone)]
pub(crate) struct Stroke {
    /// The curve.
    pub(crate) line: Line,
    /// In pixels.
    pub(crate) width: f64,
}

/// Words beside a point.
#[derive(Debug, Clone)]
pub(crate) struct Label {
    /// x and y.
    pub(crate) at: (f64, f64),
    /// What stands there.
    pub(crate) text: String,
}

/// Points without a curve through them.
#[derive(Debug, Clone)]
pub(crate) struct Cloud {
    /// x and y.
    pub(crate) points: Vec<(f64, f64)>,
    /// Its colour.
    pub(crate) style: Style,
    /// Of a point, in pixels.
    pub(crate) radius: f64,
    /// Its name in the legend, as that of a line.
    pub(crate) name: String,
}

/// A value a cell over two axes, as colours.
#[derive(Debug, Clone)]
pub(crate) struct Map {
    /// From left to right.
    pub(crate) x: Cells,
    /// From below to above.
    pub(crate) y: Cells,
    /// Rows from below to above; NaN where there is none.
    pub(crate) values: Vec<Vec<f64>>,
}

/// Where the middles of cells are.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cells {
    /// The first and the last one of several, as far from each other as all.
    Even([f64; 2]),
    /// At 1, 2, …, with what stands beside them.
    Named(Vec<String>),
}

/// A marked abscissa or ordinate.
#[derive(Debug, Clone)]
pub(crate) struct Mark {
    /// Where.
    pub(crate) x: f64,
    /// Written beside it.
    pub(crate) name: String,
}

/// A marked point.
#[derive(Debug, Clone)]
pub(crate) struct Dot {
    /// x and y.
    pub(crate) at: (f64, f64),
    /// Its name in the legend.
    pub(crate) name: String,
}

/// Style of a curve, the same in every figure: curves can be distinguished on paper without colour, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// First quantity: solid.
    First,
    /// Second quantity: dashed.
    Second,
    /// Third quantity: finely dashed.
    Third,
    /// Fourth quantity: dashes and dots.
    Fourth,
    /// One of very many curves: thin.
    Thin,
    /// A limit, such as the clearance circle: thin and dotted.
    Limit,
    /// What is not to be believed.
    Doubted,
    /// Of a body of several, by its number.
    Body(u8),
    /// By a value from least (0) to most (255): a place on the scale of colours.
    Shade(u8),
}
