//! Measures edits in process: `keystrokes LINES`.

use std::time::Instant;

use gcheck_db::{Database, Settings};

fn main() {
    for lines in std::env::args().skip(1).filter_map(|lines| lines.parse::<usize>().ok()) {
        measure(lines);
    }
}

fn measure(lines: usize) {
    let text = gcheck_testkit::inputs::surfacing(lines);
    let control = gcheck_controls::load("haas-mill").unwrap();
    let mut database = Database::new();
    let start = Instant::now();
    let id = database.open(&text, Settings::new(control));
    let found = database.analysis(id, &|| false).unwrap().findings.len();
    println!(
        "{lines} lines, {} bytes: open {:?}, {found} findings, {:?}",
        text.len(),
        start.elapsed(),
        database.work(id)
    );
    let starts: Vec<usize> =
        std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
    for (name, what) in
        [("insert G01", 0), ("delete it", 1), ("insert line", 2), ("delete line", 3), ("digit", 4)]
    {
        let mut times = Vec::new();
        let mut executed = 0;
        let mut current = text.clone();
        database.set_text(id, &text);
        let _ = database.analysis(id, &|| false);
        let _ = &starts;
        for round in 0..100_usize {
            let line = (round * 7919 + 1000) % (lines - 20) + 10;
            // Lines move by at most a hundred bytes here: the line start is looked for again.
            let guess = starts[line].min(current.len());
            let at = current[..guess].rfind('\n').map_or(0, |at| at + 1);
            let end = at + current[at..].find('\n').map_or(current.len() - at, |len| len + 1);
            let (range, insert) = match what {
                0 => (at..at, "G01 ".to_owned()),
                1 => (at..at, String::new()),
                2 => (at..at, "X1.5 Y2.5\n".to_owned()),
                3 => (at..end, String::new()),
                _ => match current[at..end].find(|c: char| c.is_ascii_digit()) {
                    Some(place) => (at + place..at + place + 1, "7".to_owned()),
                    None => continue,
                },
            };
            let clock = Instant::now();
            database.edit(id, range.start as u32..range.end as u32, &insert).unwrap();
            let analysis = database.analysis(id, &|| false).unwrap();
            times.push(clock.elapsed());
            std::hint::black_box(analysis.findings.len());
            executed += database.work(id).unwrap().executed;
            current.replace_range(range, &insert);
        }
        times.sort();
        println!(
            "  {name}: median {:?} p95 {:?} max {:?}, {executed} segments executed",
            times[times.len() / 2],
            times[times.len() * 95 / 100],
            times[times.len() - 1]
        );
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    for line in status.lines().filter(|line| line.starts_with("VmHWM") || line.starts_with("VmRSS")) {
        println!("  {line}");
    }
}
