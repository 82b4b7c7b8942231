#![expect(missing_docs, reason = "temporary")]
mod cycle_harness;
#[test]
fn show() {
    let Ok(file) = std::env::var("PROG") else { return };
    let text = std::fs::read_to_string(file).unwrap();
    let control = std::env::var("CONTROL").unwrap();
    let axes: &'static str = if control.contains("mill") { "XYZ" } else { "XZ" };
    println!("{}", cycle_harness::shown_on(&control, axes, &cycle_harness::machine(10.0), &text));
}
#[test]
fn fuzz() {
    let mut seed: u64 = std::env::var("SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let mut next = move |n: u64| { seed ^= seed << 13; seed ^= seed >> 7; seed ^= seed << 17; seed % n };
    let lines = ["G71 U5. R1.","G71 P1 Q3 U0.4 W0.1","G72 W2. R.5","G72 P1 Q3","G73 U3. W2. R3","G73 P1 Q3 U1.","G70 P1 Q3","G70 P2 Q4","N1 G0 X40.","N2 G1 Z-10.","N3 X60.","N4 G2 X50. Z-20. R6.","G3 X70. Z-30. I1. K-4.","G90 X50. Z-30. F.3","X46.","G92 X38. Z-30. F1.5","G94 X20. Z2.","G74 R1.","G74 X20. Z-15. Q8000 P1000","G75 X52. Z1. P3000 Q2500","G75 X2. Z0. I.06 K.08","G76 P020060 Q100 R.05","G76 X30. Z-30. P1000 Q600 F2.","G76 X.88 Z-1.1 K.06 D.04 F.1 A60.","G42","G40","G0 X60. Z5.","#1=#2+1.","IF [#1 LT 3] GOTO 2","G1 X#1 ,R2.","G1 Z-5. ,C3.","G91 G13 I8. Z-1. L2 D1","G13 I8. K20. Q.001 Z-3. D1","G81 Z-3. R1. F100. L0","G70 I10. J90. L4","G71 I10. K20. L90000","G72 I1. J0. L3","G150 P1 X0. Y0. Z-4. Q2. R1. J4.","G150 G41 D1 P9 Z-400. Q.00001 R1. I4.","O9","M99","G20","G21","G17","G18","GOTO 1","M98 P9","o100 sub","o100 endsub","g71 q100 i3 d.4","g70 q100 p3 d1","g71.2 q100","g72 q100 i1","g76 p1.5 z-20 i-2 j0.3 k0.5 h2","g7","g8","G53 X3.","/N3 G1 X2.","%","G98","G99","M30"];
    for control in ["fanuc-lathe","haas-lathe","linuxcnc","haas-mill","fanuc-mill","generic-mill"] {
        for _ in 0..6000 {
            let n = 2 + next(14);
            let mut text = String::from("G21 G97 S800 M3\nF100.\nG0 X60. Z5.\n");
            for _ in 0..n {
                let line = lines[next(lines.len() as u64) as usize];
                // A changed digit now and then.
                let mut line = line.to_owned();
                if next(4) == 0 { let d = char::from(b'0' + next(10) as u8); let from = char::from(b'0' + next(10) as u8); line = line.replace(from, &d.to_string()); }
                if next(9) == 0 { line = line.replace('.', ""); }
                if next(9) == 0 { line = line.replace(' ', " -").replace("--", "-").replace(" -G", " G"); }
                text.push_str(&line); text.push('\n');
            }
            std::fs::write("/tmp/lathe/last.nc", &text).unwrap();
            let start = std::time::Instant::now();
            let shown = cycle_harness::shown_fuel(control, &text, 300);
            let took = start.elapsed();
            if took.as_millis() > 700 { println!("{control} slow {took:?} {} bytes\n{text}\n---", shown.len()); }
        }
    }
}
