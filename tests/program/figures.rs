//! Figures: what they show, what they leave out, and that they are the same every time.

use axiscope::charts::{
    BarChart, BarSeries, CloudViews, Dashes, Figure, FigureError, Guide, HEIGHT, Heatmap, Histogram, Labels,
    LineChart, LinePanel, LinePoint, LineSeries, Scatter, ScatterSeries, View, ViewKey, WIDTH,
};
use resvg::{tiny_skia::Pixmap, usvg::roxmltree::Document};

fn labels() -> Labels {
    Labels::new("Error <per> cloud & μ", "Distance z₀ (cm)", "Error (°)")
}

fn lines(values: &[Option<f64>]) -> LineChart {
    let points = values
        .iter()
        .enumerate()
        .map(|(x, &y)| LinePoint {
            x: x as f64,
            y,
            spread: Some(0.5),
        })
        .collect();
    let other = LineSeries::new(
        "τ = 3/π",
        (0..5).map(|x| (f64::from(x), Some(f64::from(x) + 2.0))),
    );
    let series = vec![
        LineSeries {
            name: "as intended".to_owned(),
            points,
        },
        other,
    ];
    LineChart::new(labels(), series, vec![Guide::new(6.47, "Paper 6.47°")])
}

fn bars(values: Vec<Option<f64>>) -> BarChart {
    let categories = (1..=values.len()).map(|n| n.to_string()).collect();
    let series = vec![BarSeries {
        name: "as intended".to_owned(),
        values,
    }];
    BarChart {
        labels: labels(),
        categories,
        series,
        guides: vec![Guide::new(7.37, "Paper 7.37°")],
    }
}

fn histogram(values: Vec<f64>) -> Histogram {
    Histogram {
        labels: labels(),
        values,
        step: None,
    }
}

fn scatter(points: Vec<(f64, f64)>) -> Scatter {
    let series = vec![ScatterSeries {
        name: "as intended".to_owned(),
        points,
    }];
    Scatter {
        labels: labels(),
        series,
        guides: vec![],
    }
}

fn heatmap(cells: Vec<Vec<Option<f64>>>) -> Heatmap {
    let names = |count: usize| (0..count).map(|n| format!("{n}")).collect::<Vec<_>>();
    let columns = names(cells.first().map_or(0, Vec::len));
    Heatmap {
        labels: labels(),
        value_label: "Error (°)".to_owned(),
        columns,
        rows: names(cells.len()),
        cells,
    }
}

fn views(points: &[((f64, f64), usize)]) -> CloudViews {
    let key = |name: &str, color, line| ViewKey {
        name: name.to_owned(),
        color,
        line,
    };
    let view = |name: &str| View {
        name: name.to_owned(),
        points: points.to_vec(),
        lines: vec![([(0.0, -9.0), (0.0, 9.0)], 1)],
    };
    CloudViews {
        title: "Error <per> cloud & μ".to_owned(),
        keys: vec![
            key("fruit", BLUE, None),
            key("axis", "#009E73", Some(Dashes::Dashed)),
        ],
        columns: 2,
        views: vec![view("front"), view("side")],
        unit: "cm",
    }
}

/// One figure of every kind, with a value missing where that is possible.
fn one_of_each() -> Vec<Figure> {
    let raster: Vec<_> = (0..400)
        .map(|i| ((f64::from(i % 20), f64::from(i / 20)), 0))
        .collect();
    vec![
        lines(&[Some(6.0), None, Some(7.0), Some(8.0)]).into(),
        bars(vec![Some(6.0), None, Some(9.0)]).into(),
        histogram(vec![1.0, 2.0, 2.5, 7.0]).into(),
        scatter(vec![(0.0, 1.0), (2.0, 5.0)]).into(),
        heatmap(vec![vec![Some(1.0), None], vec![Some(3.0), Some(4.0)]]).into(),
        views(&raster).into(),
    ]
}

/// The content of every text of an SVG.
fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("well-formed XML");
    let texts = document
        .descendants()
        .filter(|node| node.tag_name().name() == "text");
    texts
        .map(|node| node.text().unwrap_or_default().trim().to_owned())
        .collect()
}

/// How many elements of an SVG have the tag and an attribute of this value.
fn count(svg: &str, tag: &str, attribute: &str, value: &str) -> usize {
    let document = Document::parse(svg).expect("well-formed XML");
    let named = document
        .descendants()
        .filter(|node| node.tag_name().name() == tag);
    named
        .filter(|node| {
            node.attribute(attribute)
                .is_some_and(|found| found.eq_ignore_ascii_case(value))
        })
        .count()
}

const BLUE: &str = "#0072b2";

#[test]
fn an_svg_holds_title_axis_labels_and_every_name() {
    for figure in one_of_each() {
        let texts = texts(&figure.svg().unwrap());
        // Views have no axes.
        let has_axes = !matches!(figure, Figure::Views(_));
        for wanted in ["Error <per> cloud & μ", "Distance z₀ (cm)", "Error (°)"]
            .into_iter()
            .take(if has_axes { 3 } else { 1 })
        {
            assert!(
                texts.iter().any(|text| text == wanted),
                "{wanted:?} is missing in {texts:?}"
            );
        }
        let names: &[&str] = match figure {
            Figure::Lines(_) => &["as intended", "τ = 3/π", "Paper 6.47°"],
            Figure::Bars(_) => &["as intended", "Paper 7.37°", "no result"],
            Figure::Scatter(_) => &["as intended"],
            Figure::Heatmap(_) => &["no result"],
            Figure::Views(_) => &["fruit", "axis", "front"],
            Figure::Histogram(_) => &[],
        };
        for name in names {
            assert!(
                texts.iter().any(|text| text == name),
                "{name:?} is missing in {texts:?}"
            );
        }
    }
}

#[test]
fn a_png_has_the_size_asked_for_and_shows_something() {
    for figure in one_of_each() {
        for scale in [0.5, 1.0] {
            let pixmap = Pixmap::decode_png(&figure.png(scale).unwrap()).unwrap();
            let asked = ((WIDTH * scale) as u32, (HEIGHT * scale) as u32);
            assert_eq!((pixmap.width(), pixmap.height()), asked);
            let inked = pixmap
                .pixels()
                .iter()
                .filter(|p| (p.red(), p.green(), p.blue()) != (255, 255, 255))
                .count();
            assert!(inked > 3000, "only {inked} pixels are drawn");
        }
    }
}

#[test]
fn texts_are_rasterized_with_the_bundled_font() {
    let dark_pixels = |title: &str| {
        let chart = Histogram {
            labels: Labels::new(title, "", ""),
            ..histogram(vec![1.0, 2.0])
        };
        let pixmap = Pixmap::decode_png(&Figure::from(chart).png(1.0).unwrap()).unwrap();
        pixmap
            .pixels()
            .iter()
            .filter(|pixel| pixel.red().max(pixel.green()).max(pixel.blue()) < 128)
            .count()
    };
    let ink_of = |glyph: &str| dark_pixels(&glyph.repeat(20)).saturating_sub(dark_pixels("."));
    let unknown = ink_of("\u{10fffd}");
    for glyph in ["a", "°", "τ", "μ", "₀"] {
        assert!(ink_of(glyph) > 100, "{glyph} is not drawn");
        assert_ne!(ink_of(glyph), unknown, "{glyph} is not in the font");
    }
}

#[test]
fn drawing_twice_gives_the_same_bytes() {
    for (first, second) in one_of_each().into_iter().zip(one_of_each()) {
        assert_eq!(first.svg(), second.svg());
        assert_eq!(first.png(0.5), second.png(0.5));
    }
}

#[test]
fn missing_values_break_lines_and_are_no_bars() {
    let values = [
        Some(6.0),
        Some(6.5),
        None,
        Some(7.0),
        Some(f64::NAN),
        Some(8.0),
        Some(8.0),
    ];
    let svg = Figure::from(lines(&values)).svg().unwrap();
    // Two runs of two points and one lone point between the gaps: two lines, five dots.
    assert_eq!(count(&svg, "path", "stroke", BLUE), 2);
    assert_eq!(count(&svg, "circle", "fill", BLUE), 5);

    let svg = Figure::from(bars(vec![Some(6.0), None, Some(f64::INFINITY), Some(9.0)]))
        .svg()
        .unwrap();
    let in_legend = 1;
    assert_eq!(count(&svg, "rect", "fill", BLUE), 2 + in_legend);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn nothing_to_draw_is_an_error() {
    let nothing: Vec<Figure> = vec![
        LineChart::new(labels(), vec![], vec![Guide::new(1.0, "guide")]).into(),
        LineChart {
            labels: labels(),
            panels: vec![],
        }
        .into(),
        LineChart::new(labels(), vec![LineSeries::new("empty", [(0.0, None)])], vec![]).into(),
        bars(vec![]).into(),
        bars(vec![None, Some(f64::NAN)]).into(),
        histogram(vec![f64::NAN]).into(),
        scatter(vec![(f64::NAN, 1.0)]).into(),
        heatmap(vec![]).into(),
        heatmap(vec![vec![None]]).into(),
        views(&[((f64::NAN, 1.0), 0)]).into(),
        CloudViews {
            views: vec![],
            ..views(&[])
        }
        .into(),
    ];
    for figure in nothing {
        assert_eq!(figure.svg(), Err(FigureError::Empty), "{figure:?}");
    }
}

#[test]
fn lists_of_different_lengths_are_an_error() {
    let chart = BarChart {
        categories: vec!["1".to_owned()],
        ..bars(vec![Some(1.0), Some(2.0)])
    };
    assert!(matches!(
        Figure::from(chart).svg(),
        Err(FigureError::Mismatch {
            expected: 1,
            found: 2,
            ..
        })
    ));
    let map = heatmap(vec![vec![Some(1.0), Some(1.0)], vec![Some(1.0)]]);
    assert!(matches!(
        Figure::from(map).svg(),
        Err(FigureError::Mismatch {
            expected: 2,
            found: 1,
            ..
        })
    ));
}

#[test]
fn views_share_one_scale_and_cut_off_long_lines() {
    let mut chart = views(&[((0.0, 0.0), 0), ((10.0, 10.0), 0)]);
    chart.views[1].points = vec![((0.0, 0.0), 0), ((5.0, 5.0), 0)];
    let svg = Figure::from(chart.clone()).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let dots: Vec<(f64, f64)> = (document.descendants())
        .filter(|n| {
            n.tag_name().name() == "circle"
                && n.attribute("fill").is_some_and(|f| f.eq_ignore_ascii_case(BLUE))
        })
        .map(|n| {
            ["cx", "cy"]
                .map(|a| n.attribute(a).unwrap().parse().unwrap())
                .into()
        })
        .collect();
    // The first is the legend's.
    let [_, a, b, c, d] = dots[..] else {
        panic!("{dots:?}")
    };
    assert!(
        (b.0 - a.0 - 2.0 * (d.0 - c.0)).abs() < 0.1 && b.0 > a.0,
        "{dots:?}"
    );
    assert!(b.1 < a.1, "y is up");
    assert_eq!(
        svg.matches("<clipPath id=").count(),
        2,
        "lines are cut off at the edge of their view"
    );
    chart.views[0].points.push(((0.0, 0.0), 7));
    assert!(matches!(
        Figure::from(chart).svg(),
        Err(FigureError::Mismatch {
            expected: 2,
            found: 8,
            ..
        })
    ));
}

#[test]
fn scales_and_ranges_without_a_picture_are_errors() {
    let figure = Figure::from(histogram(vec![1.0, 2.0]));
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e6, 1e-9] {
        assert!(matches!(figure.png(scale), Err(FigureError::Scale(_))), "{scale}");
    }
    for range in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let mut chart = lines(&[Some(1.0)]);
        chart.panels[0].y_range = Some(range);
        assert!(
            matches!(Figure::from(chart).svg(), Err(FigureError::Range(..))),
            "{range:?}"
        );
    }
    for step in [0.0, -1.0, f64::NAN, 1e-9] {
        let chart = Histogram {
            step: Some(step),
            ..histogram(vec![1.0, 2.0])
        };
        assert!(
            matches!(Figure::from(chart).svg(), Err(FigureError::Range(..))),
            "{step}"
        );
    }
}

#[test]
fn extreme_values_are_drawn_or_refused_but_never_loop() {
    let sets: [&[f64]; 11] = [
        &[0.0],
        &[0.0, 0.0],
        &[1e-12],
        &[1e9],
        &[1e-12, 1e9],
        &[5.0, 5.0, 5.0],
        &[1e9, 1e9 + 1e-6],
        &[-1e9, 1e-300],
        &[1e99, -1e99],
        &[f64::MIN_POSITIVE, 0.0],
        &[-7.5],
    ];
    for values in sets {
        let options: Vec<Option<f64>> = values.iter().copied().map(Some).collect();
        let line = LineSeries::new("values", values.iter().map(|&v| (v, Some(v))));
        let figures: [Figure; 5] = [
            LineChart::new(labels(), vec![line], vec![]).into(),
            bars(options.clone()).into(),
            histogram(values.to_vec()).into(),
            scatter(values.iter().map(|&v| (v, v)).collect()).into(),
            heatmap(vec![options]).into(),
        ];
        for figure in figures {
            let svg = figure.svg().unwrap();
            assert!(
                !svg.contains("NaN") && !svg.contains("inf"),
                "{values:?} {figure:?}"
            );
            assert!(svg.len() < 200_000, "{values:?} gave {} bytes", svg.len());
        }
    }
    assert_eq!(
        Figure::from(histogram(vec![1.0, 1e300])).svg(),
        Err(FigureError::TooLarge(1e300))
    );
}

#[test]
fn panels_have_axes_of_their_own_and_one_below_all() {
    let flat = |name: &str, level: f64| LineSeries::new(name, (25..=70).map(|z| (f64::from(z), Some(level))));
    let panel = |series, value| LinePanel {
        series,
        guides: vec![Guide::new(value, format!("paper: {value}°"))],
        y_range: None,
    };
    let panels = vec![
        panel(vec![flat("near", 6.0), flat("near, too", 8.0)], 6.47),
        panel(vec![flat("far", 55.0)], 50.0),
    ];
    let svg = Figure::from(LineChart {
        labels: labels(),
        panels,
    })
    .svg()
    .unwrap();
    let texts = texts(&svg);
    let times = |wanted: &str| texts.iter().filter(|text| *text == wanted).count();
    assert_eq!((times("Error (°)"), times("Distance z₀ (cm)")), (2, 1));
    assert_eq!((times("paper: 6.47°"), times("paper: 50°")), (1, 1));
    // Lines of two panels differ in color: a legend stands above all.
    assert_eq!(
        (
            count(&svg, "path", "stroke", BLUE),
            count(&svg, "path", "stroke", "#009e73")
        ),
        (1, 1)
    );
}

#[test]
fn names_from_files_cannot_break_the_document() {
    let mut chart = bars(vec![Some(1.0)]);
    chart.series[0].name = "a\u{1}b <c> \"d\" &e;".to_owned();
    chart.categories[0] = "x".repeat(5000);
    let texts = texts(&Figure::from(chart).svg().unwrap());
    assert!(texts.iter().any(|text| text == "a b <c> \"d\" &e;"), "{texts:?}");
    assert!(texts.iter().all(|text| text.chars().count() < 200));
}

#[test]
fn a_legend_that_fills_the_page_is_an_error() {
    let series = |n: u32| {
        LineSeries::new(
            format!("a series with a long name, number {n}"),
            [(0.0, Some(1.0))],
        )
    };
    let chart = |count: u32| Figure::from(LineChart::new(labels(), (0..count).map(series).collect(), vec![]));
    assert!(chart(8).svg().is_ok());
    assert_eq!(chart(200).svg(), Err(FigureError::NoRoom));
}
