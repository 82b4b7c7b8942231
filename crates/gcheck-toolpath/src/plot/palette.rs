//! Colours of tools.
//!
//! Knows: which colours are told apart on light and on dark ground, and by people who see few colours. Must not know: what is
//! coloured.

/// After the palette that Okabe and Ito made for all kinds of colour vision, without the red that rapid moves have and with
/// darker ones for its yellow and black. Neighbours and the first five are far apart for everybody.
const COLORS: [&str; 9] =
    ["#0072b2", "#e69f00", "#009e73", "#7a4a00", "#4b2fa8", "#d98cbb", "#5f7000", "#56b4e9", "#6e7781"];

/// The colour of a tool by its place in the list of tools; colours come again when there are many.
pub(super) fn color(index: usize) -> &'static str {
    COLORS.get(index % COLORS.len()).copied().unwrap_or("#808080")
}

#[cfg(test)]
mod tests {
    use super::COLORS;

    /// Red, green and blue in linear light.
    fn linear(color: &str) -> [f64; 3] {
        let part = |at: usize| f64::from(u8::from_str_radix(&color[at..at + 2], 16).unwrap()) / 255.0;
        [1, 3, 5].map(|at| {
            let value = part(at);
            if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        })
    }

    fn times(matrix: [[f64; 3]; 3], color: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row.iter().zip(color).map(|(a, b)| a * b).sum())
    }

    /// Lightness and two hues in which equal distances look equal (CIE 1976).
    fn lab(color: [f64; 3]) -> [f64; 3] {
        let to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let [x, y, z] = times(to_xyz, color);
        let root = |value: f64| if value > 0.008_856 { value.cbrt() } else { 7.787 * value + 16.0 / 116.0 };
        let [x, y, z] = [x / 0.9505, y, z / 1.089].map(root);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    }

    /// How people without cones for red, and without cones for green, see linear light (Viénot, Brettel and Mollon 1999).
    const WITHOUT_RED: [[f64; 3]; 3] =
        [[0.112_38, 0.887_62, 0.0], [0.112_38, 0.887_62, 0.0], [0.004_01, -0.004_01, 1.0]];
    const WITHOUT_GREEN: [[f64; 3]; 3] =
        [[0.292_75, 0.707_25, 0.0], [0.292_75, 0.707_25, 0.0], [-0.022_34, 0.022_34, 1.0]];
    const ALL: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn tools_are_told_apart_without_red_and_without_green() {
        for vision in [ALL, WITHOUT_RED, WITHOUT_GREEN] {
            let seen = COLORS.map(|color| lab(times(vision, linear(color)).map(|part| part.clamp(0.0, 1.0))));
            for (first, one) in seen.iter().enumerate() {
                for (second, other) in seen.iter().enumerate().skip(first + 1) {
                    let least = if second == first + 1 {
                        25.0
                    } else if second < 5 {
                        20.0
                    } else {
                        7.0
                    };
                    assert!(distance(*one, *other) > least, "{} {}", COLORS[first], COLORS[second]);
                }
            }
        }
    }
}
