//! `gcheck plot`: pictures and pages, looked at as text and in a real browser.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use gcheck_testkit::skips::skip;
use serde_json::Value;

use crate::shop::Shop;

/// Faces, mills a round hole and drills; one comment tries to be markup.
const PLATE: &str = "\
%
O0101 (PLATE)
G21 G17 G40 G49 G80 G90
T1 M6 (FACE MILL 40)
G0 G54 X-60. Y-30. S2000 M3
G43 H1 Z25.
G1 Z-0.5 F600.
X60. F1200.
Y0.
X-60.
Y30.
X60.
G0 Z25. (</script><b>BOLD</b> & \"QUOTED\")
T2 M6 (END MILL 8)
G54 X0. Y0. S6000 M3
G43 H2 Z25.
Z1.
G1 X18. F900.
G3 I-18. Z-3. F800.
I-18. Z-6.
I-18.
G1 X0.
G0 Z25.
T3 M6 (DRILL 6.8)
G54 X-38. Y-24. S0 M3
G43 H3 Z25.
G98 G81 Z-14. R2. F250.
X38.
G80
M30
%
";

const SHAFT: &str = "\
%
O0200 (SHAFT)
G21 G40 G99 G18
T0101 (ROUGH)
G97 S1200 M3
G0 X62. Z3.
G71 U2. R1.
G71 P10 Q20 U0.4 W0.1 F0.25
N10 G0 X20.
G1 Z-15. F0.15
X30. Z-25.
N20 X62.
G70 P10 Q20
G0 X100. Z50.
M30
%
";

#[test]
fn a_picture_shows_three_sides_and_the_whole() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    let run = shop.gcheck("plot plate.nc --control fanuc-mill -o plate.svg");
    assert_eq!((run.code, run.stdout.as_str()), (0, ""), "{}", run.stderr);
    let svg = shop.read("plate.svg");
    for title in ["XY, from above", "XZ, from the front", "YZ, from the right", "isometric"] {
        assert_eq!(svg.matches(&format!(">{title}<")).count(), 1, "{title}");
    }
    for words in
        ["T1 FACE MILL 40", "T2 END MILL 8", "T3 DRILL 6.8", "rapid moves", "extents of what is cut, mm"]
    {
        assert!(svg.contains(words), "{words}");
    }
    // What is cut, not what is passed on the way there.
    for words in ["X -60 to 60", "Y -30 to 30", "Z -14 to 25"] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    assert!(svg.contains("class=\"rapid\"") && svg.contains("class=\"cut\""));
}

#[test]
fn a_lathe_is_drawn_with_z_to_the_right_and_diameters() {
    let shop = Shop::with(&[("shaft.nc", SHAFT)]);
    assert_eq!(shop.gcheck("plot shaft.nc --control fanuc-lathe -o shaft.svg").code, 0);
    let svg = shop.read("shaft.svg");
    assert!(svg.contains(">ZX<") && !svg.contains("isometric"), "{svg}");
    assert!(svg.contains("X 20 to 62") && svg.contains("class=\"axis\""), "{svg}");
}

#[test]
fn pictures_are_the_same_every_time() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    for name in ["a.svg", "b.svg", "a.html", "b.html"] {
        assert_eq!(shop.gcheck(&format!("plot plate.nc -q --control fanuc-mill -o {name}")).code, 0);
    }
    assert_eq!(shop.read("a.svg"), shop.read("b.svg"));
    assert_eq!(shop.read("a.html"), shop.read("b.html"));
}

#[test]
fn the_name_of_the_output_says_what_is_drawn() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    let run = shop.gcheck("plot plate.nc --control fanuc-mill -o plate.png");
    assert_eq!(run.code, 2);
    assert!(
        run.stderr.contains("plate.png: the name does not say what to draw")
            && run.stderr.contains("`.html`"),
        "{}",
        run.stderr
    );
    assert_eq!(shop.names(), ["plate.nc"]);
}

#[test]
fn a_run_that_faults_is_drawn_past_the_fault_with_a_mark() {
    let broken = PLATE.replace("I-18. Z-6.", "X50. I-18. Z-6.");
    let shop = Shop::with(&[("plate.nc", broken.as_str())]);
    let run = shop.gcheck("plot plate.nc --control fanuc-mill -o plate.html");
    assert_eq!(run.code, 1, "{}", run.stderr);
    let page = shop.read("plate.html");
    assert!(page.contains("the control would stop in plate.nc, line 20: "), "the page says where");
    assert!(page.contains("\"alarms\":[{\"file\":0,\"line\":20,"), "the picture has a mark");
    assert_eq!(shop.gcheck("plot plate.nc --control fanuc-mill -o plate.svg").code, 1);
    let picture = shop.read("plate.svg");
    assert_eq!(picture.matches("l12 12m-12 0l12 -12").count(), 4, "each view has a cross");
}

#[test]
fn what_nobody_can_know_is_assumed_for_the_picture_and_told_with_its_line() {
    let text = PLATE.replace("G1 X18. F900.\n", "G65 P9832\nG31 X19. F50.\nG1 X18. F900.\nX#501\n");
    let shop = Shop::with(&[("plate.nc", text.as_str())]);
    let run = shop.gcheck("plot plate.nc --control fanuc-mill -o plate.html");
    let page = shop.read("plate.html");
    for note in [
        "plate.nc, line 18: program 9832 was not found; what it does is not drawn",
        "plate.nc, line 19: probing moves are assumed to touch at the ends of their moves",
        "X in plate.nc, line 21, X in plate.nc, line 22",
    ] {
        assert!(page.contains(note), "{note}: {}", run.stderr);
        assert!(run.stderr.contains(note), "{note}: {}", run.stderr);
    }
    // A note leads to its line.
    assert!(page.contains("\"file\":0,\"line\":18}"), "{page}");
}

#[test]
fn a_program_that_moves_nothing_is_no_mistake() {
    let shop = Shop::with(&[("none.nc", "%\nO1\nM30\n%\n")]);
    for name in ["none.svg", "none.html"] {
        let run = shop.gcheck(&format!("plot none.nc --control fanuc-mill -o {name}"));
        assert_eq!(run.code, 0, "{}", run.stderr);
        assert!(shop.read(name).contains("the program moves nothing"), "{name}");
    }
}

/// Of text that is not UTF-8, of names with quotes, of markup in comments nothing becomes a part of the page.
#[test]
fn text_of_a_program_stays_text() {
    let shop = Shop::new();
    let mut bytes = PLATE.as_bytes().to_vec();
    bytes.extend_from_slice(b"(FR\xc4SER <!-- <script>alert(1)</script>)\n");
    shop.file("a&b <i>'x'\".nc", &bytes);
    let mut command = shop.command();
    command.args(["plot", "a&b <i>'x'\".nc", "--control", "fanuc-mill", "-o", "page.html"]);
    assert_eq!(shop.finish(&mut command, b"").code, 0);
    let page = shop.read("page.html");
    // The data's and the page's own.
    assert_eq!(page.matches("</script").count(), 2);
    assert_eq!(page.matches("<script").count(), 2);
    assert!(!page.contains("<!--") && !page.contains("<b>BOLD") && !page.contains("<i>"));
    assert!(page.contains("FR\u{fffd}SER"));
    let data = page.split_once("id=\"data\">").unwrap().1.split_once("</script>").unwrap().0;
    let data: Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["title"], "a&b <i>'x'\".nc");
    assert!(data["sources"][0]["text"].as_str().unwrap().contains("</script><b>BOLD</b>"));
    let mut command = shop.command();
    command.args(["plot", "a&b <i>'x'\".nc", "--control", "fanuc-mill", "-o", "page.svg"]);
    assert_eq!(shop.finish(&mut command, b"").code, 0);
    assert!(shop.read("page.svg").contains("<title>a&amp;b &lt;i&gt;&#39;x&#39;&quot;.nc</title>"));
}

/// The page loads nothing, and would not be allowed to.
#[test]
fn a_page_needs_nothing_else() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    assert_eq!(shop.gcheck("plot plate.nc --control fanuc-mill -o plate.html").code, 0);
    let page = shop.read("plate.html");
    assert!(page.contains("Content-Security-Policy\" content=\"default-src 'none'"));
    // The name of the elements of SVG looks like an address, and nobody asks for it.
    let page = page.replace("http://www.w3.org/2000/svg", "");
    for address in ["http://", "https://", "src=", "@import", "fetch("] {
        assert!(!page.contains(address), "{address}");
    }
}

#[test]
fn many_moves_are_thinned_and_the_page_says_so() {
    let mut text = String::from("%\nO1\nG21 G90 G17\nT1 M6\nG0 X0. Y0. S100 M3\nG43 H1 Z5.\nG1 Z-1. F500.\n");
    for at in 0..600_000_u64 {
        let (x, y) = (at * 7919 % 1000, at * 31 % 97);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "X{}.{x:03} Y{y}.{:03}", at / 1000, at * 17 % 1000);
    }
    text.push_str("M30\n%\n");
    let shop = Shop::with(&[("long.nc", text.as_str())]);
    let run = shop.gcheck("plot long.nc --control fanuc-mill -o long.html");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("moves are drawn with"), "{}", run.stderr);
    let length = fs::metadata(shop.path("long.html")).unwrap().len();
    assert!(length < 40_000_000, "{length}");
}

/// Where a browser may be.
const BROWSERS: [&str; 4] = [
    "/usr/bin/chromium",
    "/usr/bin/chromium-browser",
    "/usr/bin/google-chrome",
    "/usr/bin/google-chrome-stable",
];

/// What a script of `tests/browser` sees on a page, which loads nothing else; `None` where the tools are missing.
fn look(script: &str, page: &Path) -> Option<Value> {
    let seen = run_script(script, page)?;
    let name = page.file_name().unwrap().to_str().unwrap();
    assert_eq!(seen["requests"], serde_json::json!([name]), "nothing else is loaded");
    Some(seen)
}

/// What a script of `tests/browser` prints; `None` where the tools are missing.
fn run_script(script: &str, page: &Path) -> Option<Value> {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let tools = crate_folder.join("../../.test-tools");
    let browser = BROWSERS.iter().map(Path::new).find(|path| path.exists());
    let (Some(browser), true) = (browser, tools.join("node_modules/playwright-core").exists()) else {
        skip(script, "Chromium or playwright-core", "`cargo xtask test` installs both");
        return None;
    };
    // Pictures of the last run stay for people to look at.
    let pictures = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("plot-pictures");
    fs::create_dir_all(&pictures).unwrap();
    let output = Command::new("node")
        .arg(crate_folder.join("tests/browser").join(script))
        .args([tools.as_path(), browser, page, &pictures])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let seen: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(seen["problems"], Value::Array(Vec::new()), "{seen:#}");
    Some(seen)
}

#[test]
fn a_page_works_in_a_browser() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    assert_eq!(shop.gcheck("plot plate.nc --control fanuc-mill -o plate.html").code, 0);
    let Some(seen) = look("look.mjs", &shop.path("plate.html")) else { return };
    let text = |key: &str| seen[key].as_str().unwrap_or_else(|| panic!("{key}: {seen:#}")).to_owned();

    assert_eq!(seen["message"], 0, "the path is drawn");
    assert_eq!(text("title"), "plate.nc");
    assert!(
        text("summary").starts_with("fanuc-mill") && text("summary").contains("X -60.000 to 60.000"),
        "{seen:#}"
    );
    assert_eq!(seen["tools"][0], "T1 FACE MILL 40");

    assert_eq!(seen["lines"][1], "O0101 (PLATE)");
    assert_eq!(seen["lines"][12], "G0 Z25. (</script><b>BOLD</b> & \"QUOTED\")");
    assert_eq!(seen["boldElements"], 0);

    assert_eq!(
        text("readoutOfLine8"),
        "line 8 · feed · X60.000 Y-30.000 Z-0.500 · F1200 mm/min · S2000 · T1 · 0:14 · 1:02 left"
    );
    assert_eq!(text("chosen"), "8");
    assert_eq!(
        text("picked"),
        "line 8 · feed · X60.000 Y-30.000 Z-0.500 · F1200 mm/min · S2000 · T1 · 0:14 · 1:02 left"
    );

    assert!(seen["findings"].as_array().unwrap().len() == 1 && seen["marked"] == 1, "{seen:#}");
    assert_eq!(text("lineOfFinding"), "27");

    assert_eq!(text("playStops"), "Play");
    // The first place that is known comes after a tool change.
    assert_eq!(text("clockAtStart"), "0:05");
    assert_ne!(text("clockInPlay"), text("clockAtEnd"));
    assert!(text("afterOneStep").starts_with("line "), "{seen:#}");

    assert_eq!((text("theme").as_str(), text("backgroundLight").as_str()), ("dark", "251,251,250"));
    let count = |key: &str| seen[key].as_u64().unwrap();
    assert!(
        count("blueWithTool") > 2 * count("blueWithoutTool") + 1_000,
        "a hidden tool is not drawn: {seen:#}"
    );
    assert_eq!(seen["scrollsSideways"], false);
}

#[test]
fn the_options_of_a_page_work_in_a_browser() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    assert_eq!(shop.gcheck("plot plate.nc --control fanuc-mill -o plate.html").code, 0);
    let Some(seen) = look("options.mjs", &shop.path("plate.html")) else { return };
    let text = |key: &str| seen[key].as_str().unwrap_or_else(|| panic!("{key}: {seen:#}")).to_owned();
    let count = |key: &str| seen[key].as_u64().unwrap_or_else(|| panic!("{key}: {seen:#}"));
    let words = |key: &str| {
        let all = seen[key].as_array().unwrap_or_else(|| panic!("{key}: {seen:#}"));
        all.iter().map(|word| word.as_str().unwrap_or_default().to_owned()).collect::<Vec<_>>()
    };

    assert_eq!(
        text("readout"),
        "line 10 · feed · X-60.000 Y0.000 Z-0.500 · F1200 mm/min · S2000 · T1 · 0:21 · 0:54 left"
    );
    assert_eq!(words("speeds").last().map(String::as_str), Some("all in 1 min"));

    // Colours, with the numbers of their legends.
    assert!(count("redOfRapids") > 100 && count("redWithoutRapids") == 0, "rapid moves are red: {seen:#}");
    assert_eq!(words("feeds"), ["Feed along the path, mm/min", "250", "600", "800", "900", "1200"]);
    let of_feeds = seen["pixelsOfFeeds"].as_array().unwrap();
    assert!(of_feeds.len() == 5 && of_feeds.iter().all(|count| count.as_u64() > Some(10)), "{seen:#}");
    assert_eq!(words("heights"), ["Z, mm", "25.000", "15.250", "5.500", "-4.250", "-14.000"]);
    assert_eq!(words("times"), ["Time, min:s", "1:15", "0:56", "0:38", "0:19", "0:00"]);
    assert!(count("colorsByTime") > 10, "{seen:#}");
    assert_eq!(words("spindle"), ["Spindle, turns/min", "0", "2000", "6000"]);

    // What is hidden is not drawn, and comes back.
    assert!(count("drawnAboveZero") * 5 < count("drawnAtAllHeights") * 4, "{seen:#}");
    assert_eq!(count("drawnAtAllHeights"), count("drawnAtAllHeightsAgain"));
    assert_eq!(text("numberOfHeight"), "0.000");
    assert!(text("sliderOfHeight").ends_with(" mm") && text("sliderOfHeight") != "0.000 mm", "{seen:#}");
    assert_eq!(words("operations")[1], "T2 END MILL 8\nT2, lines 15 to 23, 0:33");
    assert!(count("drawnWithNone") < count("drawnWithoutOne"), "{seen:#}");
    assert!(count("drawnWithoutOne") < count("drawnWithAll"), "{seen:#}");
    assert_eq!(count("drawnWithAll"), count("drawnWithAllAgain"));

    // Measures by key and by click.
    assert_eq!(text("measureBegins"), "true");
    let from_to = ["from end", "X60.000 Y-30.000 Z-0.500", "to end", "X60.000 Y0.000 Z-0.500"];
    assert_eq!(words("measured")[..4], from_to);
    let between = ["ΔX", "0.000 mm", "ΔY", "30.000 mm", "ΔZ", "0.000 mm", "distance", "30.000 mm"];
    assert_eq!(words("measured")[4..], between);
    assert_eq!(words("centre"), ["from centre of the arc, R 18.000", "X0.000 Y0.000 Z-3.000"]);
    assert_eq!(text("noCentre"), "The chosen move has no centre: choose another.");
    assert_eq!((text("measureEnds").as_str(), count("nothingMeasured")), ("false", 0));
    assert_eq!(words("clicked")[..2], from_to[..2]);
    let grown = &seen["chosenGrows"];
    assert!(grown[1].as_u64() > grown[0].as_u64().map(|before| 2 * before), "{seen:#}");

    // Pictures to keep.
    assert_eq!(seen["png"]["name"], "plate.png");
    assert_eq!(seen["png"]["start"], serde_json::json!([0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A]));
    assert!(count("inkOfPng").abs_diff(count("inkOfView")) * 20 < count("inkOfView"), "{seen:#}");
    for svg in seen["svgs"].as_array().unwrap() {
        assert_eq!((&svg["name"], &svg["dashed"]), (&"plate.svg".into(), &true.into()), "{svg:#}");
        assert_eq!(svg["covered"], serde_json::json!([]), "words cover each other");
    }
    let first = seen["svgs"][0]["words"].as_array().unwrap();
    assert!(
        ["X 120.000", "Y 60.000", "Z 39.000"].iter().all(|size| first.contains(&Value::from(*size))),
        "{seen:#}"
    );

    // For everybody.
    assert_eq!(words("contrast"), ["contrast", "0,0,0"]);
    assert_eq!(words("themesOfSystem"), ["contrastLight", "contrast", "contrastLight", "dark", "light"]);
    for key in ["nameless", "ringless", "overlapsWhenNarrow", "overlapsInOptions"] {
        assert_eq!(words(key), Vec::<String>::new(), "{key}");
    }
    assert_eq!(seen["closedByItself"], true, "the options make room for the path");
    assert!(count("steps") <= 5, "{seen:#}");
    assert_eq!((&seen["scrollsSideways"], &seen["optionsOfNarrow"]), (&false.into(), &true.into()));
}

/// Work on a rotary axis: a groove around a bar, and two holes at its sides.
const ROTARY: &str = "%\nO1 (ROTARY)\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nT1 M6 (6 MM BALL)\n(WRAP)\nG0 X0. Y0. Z40. A0. S5000 M3\nG43 H1 Z30.\nG1 Z25. F200.\nG1 X20. A360. F500.\nG1 X40. A720.\nG0 Z40.\nT2 M6 (DRILL)\nG0 X10. Y0. Z40. A90.\nG43 H2 Z40.\nG1 Z15. F100.\nG0 Z40.\nA180.\nG1 Z15.\nG0 Z40.\nM30\n%\n";

#[test]
fn a_page_turns_the_part_with_its_rotary_axis_and_steps_from_operation_to_operation() {
    let shop = Shop::with(&[("bar.nc", ROTARY)]);
    let run = shop.gcheck("plot bar.nc -o bar.html");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let Some(seen) = look("rotary.mjs", &shop.path("bar.html")) else { return };
    assert_eq!(seen["ways"], serde_json::json!(["A does not turn", "A around the part", "A unrolled"]));
    // What the program says of the end of the hole stays; it is drawn at the side of the bar, or a quarter of its girth away.
    for way in ["still", "around", "unrolled"] {
        assert_eq!(seen["readouts"][way], "X10.000 Y0.000 Z15.000 A90", "{way}: {seen:#}");
    }
    let drawn = |way: &str| seen["drawn"][way].as_str().unwrap_or_default().to_owned();
    assert_eq!(drawn("still"), "X10.000 Y0.000 Z15.000", "{seen:#}");
    assert_eq!(drawn("around"), "X10.000 Y-15.000 Z0.000", "{seen:#}");
    assert_eq!(drawn("unrolled"), "X10.000 Y-39.270 Z15.000", "{seen:#}");
    let ink = |way: &str| seen["ink"][way].as_u64().unwrap_or_default();
    assert!(ink("around") > ink("still") + 1_000, "a helix is more than a line: {seen:#}");
    assert_eq!(seen["operations"], serde_json::json!(["line 12", "line 20", "line 12"]), "{seen:#}");
    assert_eq!(
        seen["addresses"],
        serde_json::json!(["line 11", "line 16", "line 16", "line 16"]),
        "{seen:#}"
    );
}

#[test]
fn a_million_moves_turn_at_a_pace_that_people_can_follow() {
    let mut text =
        String::from("%\nO1\nG21 G90 G17\nT1 M6\nG0 X0. Y0. S100 M3\nG43 H1 Z5.\nG1 Z-1. F5000.\n");
    for at in 0..1_000_000_u64 {
        let (column, row) = (at % 1000, at / 1000);
        let x = if row % 2 == 0 { column } else { 999 - column };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "X{}.{} Y{}.{} Z-{}.{:03}",
            x / 10,
            x % 10,
            row / 10,
            row % 10,
            at % 3,
            at * 7919 % 1000
        );
    }
    text.push_str("M30\n%\n");
    let shop = Shop::with(&[("million.nc", text.as_str())]);
    let run = shop.gcheck("plot million.nc --control fanuc-mill -o million.html");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let Some(seen) = run_script("frames.mjs", &shop.path("million.html")) else { return };
    let frames: Vec<u64> = seen["frames"].as_array().unwrap().iter().filter_map(Value::as_u64).collect();
    assert_eq!(frames.len(), 60, "{seen:#}");
    assert!(seen["summary"].as_str().unwrap().contains("1,000,0"), "{seen:#}");
    // The one in the middle: the machine may do other things as well.
    assert!(frames[30] <= 150, "{frames:?}");
}

/// What an editor does with the viewer: it shows one text after the other, of which some make no move.
#[test]
fn the_viewer_takes_other_data_and_comes_to_an_end() {
    let shop = Shop::with(&[("plate.nc", PLATE)]);
    assert_eq!(shop.gcheck("plot plate.nc --control fanuc-mill -o plate.html").code, 0);
    let Some(seen) = run_script("viewer.mjs", &shop.path("plate.html")) else { return };
    let count = |key: &str| seen[key].as_u64().unwrap_or_else(|| panic!("{key}: {seen:#}"));

    assert_eq!(seen["short"], "toolpath data end before their last point");
    assert!(
        seen["endless"].as_str().unwrap().starts_with("toolpath data with a run from 0 to 0 of "),
        "{seen:#}"
    );

    // After its end nothing is drawn, and the graphics card has its memory back.
    for key in ["texturesAfterwards", "inkAfterwards", "inkLater", "overlaysAfterwards"] {
        assert_eq!(count(key), 0, "{key}: {seen:#}");
    }

    assert!(count("operations") > 1 && count("uploadsOfNone") == 1, "{seen:#}");
    assert!(count("hovers") > 1 && count("newsOfHover") == 0, "{seen:#}");

    assert_eq!((count("inkOfNothing"), count("piecesOfNothing")), (0, 0), "{seen:#}");
    let kept = serde_json::json!({ "coloring": "feed", "isTicked": false, "isAsBefore": true });
    assert_eq!(seen["afterNothing"], kept, "{seen:#}");

    assert_eq!(seen["lost"], "No picture is saved: the graphics card is lost.");
    assert_eq!(seen["inkIsBack"], true, "{seen:#}");

    assert_eq!(seen["switches"], serde_json::json!(["T1", "Rapid moves", "Former path"]));
    let former = serde_json::json!({
        "isInSvg": true, "isInSvgWithoutSwitch": false, "isSeen": true, "staysWithoutNews": true,
        "isInSvgOfAnotherProgram": false,
    });
    assert_eq!(seen["former"], former, "{seen:#}");

    assert_eq!(
        seen["turning"],
        serde_json::json!([2.5, 22.5]),
        "a quarter of the way, a quarter of the turn"
    );
    let around = serde_json::json!({
        "words": ["G54", "G55", "X− travel", "X+ travel, crossed", "Y− travel", "Y+ travel"],
        "before": 0, "rings": 2, "ink": true, "ringsOnLathe": 0, "ringsOfTilted": 0,
    });
    assert_eq!(seen["around"], around, "{seen:#}");
    assert_eq!((&seen["turned"], &seen["turningFromUnknown"]), (&90.into(), &90.into()));
}

/// On a lathe X is a diameter, in differences too.
#[test]
fn a_lathe_is_measured_in_diameters() {
    let shop = Shop::with(&[("shaft.nc", SHAFT)]);
    assert_eq!(shop.gcheck("plot shaft.nc --control fanuc-lathe -o shaft.html").code, 0);
    let Some(seen) = look("lathe.mjs", &shop.path("shaft.html")) else { return };
    let expected = ["ΔX (diameter)", "10.000 mm", "ΔZ", "-10.000 mm", "distance", "11.180 mm"];
    assert_eq!(seen["measured"], serde_json::json!(expected), "{seen:#}");
    assert_eq!(seen["feed"], "F0.15 mm/turn");
}
