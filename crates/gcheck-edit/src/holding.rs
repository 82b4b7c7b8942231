//! What a change promises held against what the changed program does.
//!
//! Knows: that a change of order is compared section by section. Must not know: how the programs are run.

use gcheck_toolpath::{Act, Differences, Outline, Rest, Sections, compare};

use crate::change::Change;

/// The acts of a run.
type Acts<'a> = &'a mut dyn Iterator<Item = Act>;

/// Takes the acts that a change promises, and those of the changed program.
pub type Holder<'a> = &'a mut dyn FnMut(Acts<'_>, Acts<'_>);

/// Compares the acts that a change promises with those of the changed program. `both` runs both programs and hands their acts
/// on; it is called again for each pass that sections in another order need.
///
/// # Errors
/// Those of `both`.
pub fn hold<E>(
    change: &Change,
    tolerance: f64,
    both: &mut dyn FnMut(Holder<'_>) -> Result<(), E>,
) -> Result<Differences, E> {
    let mut differences = Differences::default();
    if change.moves_sections() {
        let [mut promised, mut made] = [Outline::of_tools(), Outline::of_tools()];
        both(&mut |a, b| {
            a.for_each(|act| promised.add(&act));
            b.for_each(|act| made.add(&act));
        })?;
        if let Some(sections) = Sections::new([promised, made], tolerance, Rest::Leave) {
            differences = sections.begun();
            for pass in 0..sections.passes() {
                both(&mut |a, b| {
                    sections.compare(pass, &mut *a, &mut *b, &mut differences);
                    // A run that nobody listens to would be cut off, and end nowhere of its own.
                    a.for_each(drop);
                    b.for_each(drop);
                })?;
            }
            return Ok(differences);
        }
    }
    both(&mut |a, b| differences = compare(a, b, tolerance, Rest::Leave))?;
    Ok(differences)
}

/// Does the changed program do what the change claims?
pub fn is_as_claimed(change: &Change, differences: &Differences) -> bool {
    if change.moves_sections() { differences.is_same_but_for_order() } else { differences.is_same() }
}
