//! The colours of everything: of plots, of what is drawn as solids, and of the replay ([`crate::solid`] says what is drawn).
//!
//! Those of plots are for light and dark: every colour is written in its light form, and a style sheet that selects on that
//! value gives it its dark one, so that a viewer without style sheets still shows the light picture.
//!
//! The series are the palette of Okabe and Ito, *Color Universal Design* (2008), darkened on white and lightened on black until
//! each stands out from its ground by at least 3 to 1.

use std::fmt::Write as _;

use kinemark_sim::model::scene::BodyKind;

/// A colour with its meaning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Colour {
    /// On a light ground; also the key of the style sheet, so no two in [`ALL`] are equal.
    pub(crate) light: (u8, u8, u8),
    dark: (u8, u8, u8),
    /// Dashes in the units of a picture, where the line is dashed.
    pub(crate) dashes: Option<&'static str>,
}

const fn colour(light: (u8, u8, u8), dark: (u8, u8, u8)) -> Colour {
    Colour {
        light,
        dark,
        dashes: None,
    }
}

/// The same colour as a dashed line.
const fn dashed(solid: Colour, dashes: &'static str) -> Colour {
    Colour {
        dashes: Some(dashes),
        ..solid
    }
}

/// The ground.
pub(crate) const PAPER: Colour = colour((255, 255, 255), (22, 26, 32));
/// Titles.
pub(crate) const INK: Colour = colour((28, 34, 44), (232, 235, 240));
/// Axes and legends.
pub(crate) const MUTED: Colour = colour((84, 94, 108), (170, 180, 193));
/// Frames of panels.
pub(crate) const FRAME: Colour = colour((176, 185, 197), (84, 94, 108));
/// Lines of the grid.
pub(crate) const GRID: Colour = colour((232, 235, 240), (42, 49, 59));
/// What was measured.
pub(crate) const BLUE: Colour = colour((0, 108, 174), (98, 184, 240));
/// What was commanded, and what is bad.
pub(crate) const VERMILLION: Colour = colour((198, 82, 0), (255, 148, 82));
/// Goals, and what is good.
pub(crate) const GREEN: Colour = colour((0, 126, 92), (56, 200, 156));
/// The reference.
pub(crate) const PURPLE: Colour = colour((158, 74, 128), (230, 156, 200));
/// The reference as a dashed line.
pub(crate) const PURPLE_DASHED: Colour = dashed(PURPLE, "60 70");
/// What a linear loop would do, on the line of a run that may be the same.
pub(crate) const AMBER_DASHED: Colour = dashed(AMBER, "130 70");
/// Several series, in the order in which they are drawn.
pub(crate) const SERIES: [Colour; 6] = [BLUE, VERMILLION, GREEN, PURPLE, AMBER, INK];
/// The same as dashed lines, for the prediction of each.
pub(crate) const SERIES_DASHED: [Colour; 6] = [
    dashed(BLUE, "60 70"),
    dashed(VERMILLION, "60 70"),
    dashed(GREEN, "60 70"),
    PURPLE_DASHED,
    dashed(AMBER, "60 70"),
    dashed(INK, "60 70"),
];
/// A limit that earns all points.
pub(crate) const GREEN_DASHED: Colour = dashed(GREEN, "60 35");
/// A limit that earns none, or that must not be passed.
pub(crate) const VERMILLION_DASHED: Colour = dashed(VERMILLION, "60 35");
/// A quiet line beside the one that counts.
pub(crate) const MUTED_DASHED: Colour = dashed(MUTED, "20 30");
/// What can be moved.
pub(crate) const AMBER: Colour = colour((146, 100, 0), (226, 178, 64));
/// Where a run ended before its time.
pub(crate) const RED: Colour = colour((190, 30, 45), (255, 120, 125));

/// A colour in red, green and blue.
pub(crate) type Rgb = (u8, u8, u8);

/// The colour of a solid, which each renderer lights in its own way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SolidColour {
    /// In a storyboard.
    pub(crate) storyboard: Rgb,
    /// In viewers of logs, each part from 0 to 1.
    #[cfg_attr(not(feature = "log"), expect(dead_code, reason = "no log is written"))]
    pub(crate) log: [f64; 3],
    /// In the replay on a light and on a dark page, as `theme.ts` has it.
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "the test compares it with `theme.ts`")
    )]
    replay: [&'static str; 2],
}

/// The link that does not move.
const ROOT_LINK: SolidColour = SolidColour {
    storyboard: (150, 158, 170),
    log: [0.55, 0.6, 0.66],
    replay: ["#5d6b7d", "#5f6d80"],
};
/// The links that do, in turn, so that neighbours differ.
const MOVING_LINKS: [SolidColour; 2] = [
    SolidColour {
        storyboard: (64, 138, 200),
        log: [0.0, 0.45, 0.7],
        replay: ["#8ba4c0", "#7d9ac0"],
    },
    SolidColour {
        storyboard: (138, 196, 236),
        log: [0.34, 0.71, 0.91],
        replay: ["#c6d2df", "#b6c4d4"],
    },
];
const FIXED_BODY: SolidColour = SolidColour {
    storyboard: (205, 190, 166),
    log: [0.75, 0.68, 0.58],
    replay: ["#c3b297", "#8f8069"],
};
const KINEMATIC_BODY: SolidColour = SolidColour {
    storyboard: (232, 170, 60),
    log: [0.9, 0.62, 0.0],
    replay: ["#86aa9d", "#5f8f80"],
};
const DYNAMIC_BODY: SolidColour = SolidColour {
    storyboard: (220, 110, 56),
    log: [0.84, 0.37, 0.0],
    replay: ["#e0b040", "#d2a338"],
};

/// The colour of a link by its place in the robot.
pub(crate) fn of_link(index: usize) -> SolidColour {
    match index {
        0 => ROOT_LINK,
        _ => MOVING_LINKS[(index - 1) % 2],
    }
}

/// The colour of a body by what moves it.
pub(crate) fn of_body(kind: &BodyKind) -> SolidColour {
    match kind {
        BodyKind::Fixed => FIXED_BODY,
        BodyKind::Kinematic(_) => KINEMATIC_BODY,
        BodyKind::Free => DYNAMIC_BODY,
    }
}

/// What a storyboard lays on the ground below a solid.
pub(crate) const SHADOW: Rgb = (228, 231, 236);

/// Colours in viewers of logs that no solid has: red, green, blue and how much they cover, each from 0 to 1.
#[cfg(feature = "log")]
pub(crate) mod log {
    /// Where a goal earns all points.
    pub(crate) const FULL: [f64; 4] = [0.0, 0.62, 0.45, 0.6];
    /// Where it earns none.
    pub(crate) const ZERO: [f64; 4] = [0.84, 0.37, 0.0, 0.2];
    /// The reference solution's path.
    pub(crate) const REFERENCE_PATH: [f64; 4] = [0.8, 0.47, 0.65, 0.5];
    /// The reference solution's arm, and what it moved.
    pub(crate) const REFERENCE_ARM: [f64; 4] = [0.8, 0.47, 0.65, 0.35];
}

const ALL: [Colour; 11] = [
    PAPER, INK, MUTED, FRAME, GRID, BLUE, VERMILLION, GREEN, PURPLE, AMBER, RED,
];

/// A colour as pictures write it.
pub(crate) fn hex((r, g, b): (u8, u8, u8)) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// The style sheet of plots: fonts, and the dark ground.
pub(crate) fn plot_css() -> String {
    let mut css = String::from(
        ".plot text{font-family:system-ui,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;\
         font-variant-numeric:tabular-nums}.plot path{stroke-linejoin:round}",
    );
    css.push_str("@media screen and (prefers-color-scheme:dark){");
    for colour in ALL {
        let (key, dark) = (hex(colour.light), hex(colour.dark));
        // writing into a string cannot fail
        let _ = write!(
            css,
            ".plot [stroke=\"{key}\"]{{stroke:{dark}}}.plot [fill=\"{key}\"]{{fill:{dark}}}"
        );
    }
    css.push('}');
    css
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(colour: (u8, u8, u8)) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                libm::pow((c + 0.055) / 1.055, 2.4)
            }
        };
        0.2126 * linear(colour.0) + 0.7152 * linear(colour.1) + 0.0722 * linear(colour.2)
    }

    fn contrast(a: (u8, u8, u8), b: (u8, u8, u8)) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_colour_is_a_key_of_its_own() {
        for (i, a) in ALL.iter().enumerate() {
            assert!(ALL[..i].iter().all(|b| a.light != b.light), "{:?}", a.light);
        }
    }

    #[test]
    fn lines_and_text_stand_out_from_their_ground() {
        for colour in [BLUE, VERMILLION, GREEN, PURPLE, AMBER] {
            assert!(
                contrast(colour.light, PAPER.light) >= 3.0,
                "{:?}",
                colour.light
            );
            assert!(
                contrast(colour.dark, PAPER.dark) >= 3.0,
                "{:?}",
                colour.dark
            );
        }
        for colour in [INK, MUTED, RED, VERMILLION] {
            assert!(
                contrast(colour.light, PAPER.light) >= 4.5,
                "{:?}",
                colour.light
            );
            assert!(
                contrast(colour.dark, PAPER.dark) >= 4.5,
                "{:?}",
                colour.dark
            );
        }
    }

    /// The value of `name` in the part of a source that begins with `part`.
    fn colour_in(source: &str, part: &str, name: &str) -> String {
        let (_, rest) = source.split_once(part).expect(part);
        let (_, rest) = rest.split_once(name).expect(name);
        let start = rest.find('#').expect("a colour");
        rest[start..start + 7].to_ascii_uppercase()
    }

    /// The viewer's colours are in `theme.ts`, which is built into the bundle.
    #[test]
    fn the_replay_has_the_colours_of_solids() {
        let theme = include_str!("../../web/src/theme.ts");
        for (i, part) in ["LIGHT: Theme", "DARK: Theme"].into_iter().enumerate() {
            let (_, rest) = theme.split_once(part).expect(part);
            let (theme, _) = rest.split_once("};").expect("its end");
            let [root, odd, even] = [0, 1, 2].map(|link| of_link(link).replay[i]);
            for line in [
                format!("link: [\"{root}\", \"{odd}\", \"{even}\"],"),
                format!("fixed: \"{}\",", FIXED_BODY.replay[i]),
                format!("driven: \"{}\",", KINEMATIC_BODY.replay[i]),
                format!("free: \"{}\",", DYNAMIC_BODY.replay[i]),
            ] {
                assert!(theme.contains(&line), "{part} has no `{line}`");
            }
        }
    }

    /// A colour means one thing on a page: that of the replay and its legend is that of the plots.
    #[test]
    fn the_replay_has_the_colours_of_the_plots() {
        let theme = include_str!("../../web/src/theme.ts");
        let css = include_str!("../../web/src/viewer.css");
        let dark_css = &css[css
            .find("prefers-color-scheme:dark")
            .expect("a dark screen")..];
        for (in_theme, in_css, colour) in [
            ("trail:", "--trail:", BLUE),
            ("reference:", "--reference:", PURPLE),
            ("ghost:", "--ghost:", PURPLE),
            ("goal:", "--goal:", GREEN),
            ("path:", "", GREEN),
            ("contact:", "--contact:", VERMILLION),
            ("", "--stop:", RED),
        ] {
            if !in_theme.is_empty() {
                assert_eq!(
                    colour_in(theme, "LIGHT", in_theme),
                    hex(colour.light),
                    "{in_theme}"
                );
                assert_eq!(
                    colour_in(theme, "DARK", in_theme),
                    hex(colour.dark),
                    "{in_theme}"
                );
            }
            if !in_css.is_empty() {
                assert_eq!(
                    colour_in(css, ".replay", in_css),
                    hex(colour.light),
                    "{in_css}"
                );
                assert_eq!(
                    colour_in(dark_css, "{", in_css),
                    hex(colour.dark),
                    "{in_css}"
                );
            }
        }
    }
}
