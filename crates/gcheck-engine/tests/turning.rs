mod cycle_harness;
#[test]
fn show() {
    let text = std::fs::read_to_string(std::env::var("PROG").unwrap()).unwrap();
    let control = std::env::var("CONTROL").unwrap();
    let axes: &'static str = if control.contains("mill") { "XYZ" } else { "XZ" };
    println!("{}", cycle_harness::shown_on(&control, axes, &cycle_harness::machine(10.0), &text));
}
