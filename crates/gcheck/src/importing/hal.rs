//! HAL files: the limits of axes, joints and the trajectory that they set.
//!
//! Knows: `setp` and `sets` of the pins that the control makes of its limits, as the manual page of its task controller
//! (milltask) lists them. Must not know: INI files, what a limit is used for.

/// A limit that a command sets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Limit<'t> {
    /// The pin, as the file writes it.
    pub(super) pin: &'t str,
    /// The section of an INI file that has the same limit.
    pub(super) section: String,
    /// Its key there.
    pub(super) key: &'static str,
    /// What it is set to, as written; `None` where a signal drives it.
    text: Option<&'t str>,
}

impl Limit<'_> {
    /// The number that it is set to; `ini` gives the value of a section and key of the INI file.
    pub(super) fn value(&self, ini: impl Fn(&str, &str) -> Option<String>) -> Result<String, String> {
        let Some(text) = self.text else {
            return Err("a signal sets it while the machine runs".to_owned());
        };
        // `[AXIS_X]MAX_VELOCITY` stands for a value of the INI file.
        if let Some((section, key)) = text.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            return ini(section.trim(), key.trim())
                .ok_or_else(|| format!("it is set to `{text}`, which the INI file does not have"));
        }
        Ok(text.to_owned())
    }
}

/// The limits that the commands of a file set, in its order.
pub(super) fn limits(text: &str) -> impl Iterator<Item = Limit<'_>> {
    text.lines().filter_map(|line| {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        match words.next()? {
            "setp" => {
                let pin = words.next()?;
                let value = words.next()?;
                limit(pin, Some(value.trim_start_matches('=')))
            }
            // `net NAME … => ini.x.max_velocity`
            "net" => words.skip(1).find_map(|word| limit(word, None)),
            _ => None,
        }
    })
}

/// The limit of a pin.
fn limit<'t>(pin: &'t str, text: Option<&'t str>) -> Option<Limit<'t>> {
    let rest = pin.strip_prefix("ini.")?;
    let (section, key) = match rest.split_once('.') {
        None => {
            let key = match rest {
                "traj_max_velocity" => "MAX_LINEAR_VELOCITY",
                "traj_max_acceleration" => "MAX_LINEAR_ACCELERATION",
                _ => return None,
            };
            ("TRAJ".to_owned(), key)
        }
        Some((of, key)) => {
            let key = match key {
                "max_velocity" => "MAX_VELOCITY",
                "max_acceleration" => "MAX_ACCELERATION",
                "max_jerk" => "MAX_JERK",
                "min_limit" => "MIN_LIMIT",
                "max_limit" => "MAX_LIMIT",
                _ => return None,
            };
            let is_joint = !of.is_empty() && of.bytes().all(|byte| byte.is_ascii_digit());
            let is_axis = of.len() == 1 && of.bytes().all(|byte| byte.is_ascii_alphabetic());
            match (is_joint, is_axis) {
                (true, _) => (format!("JOINT_{of}"), key),
                (_, true) => (format!("AXIS_{}", of.to_ascii_uppercase()), key),
                _ => return None,
            }
        }
    };
    Some(Limit { pin, section, key, text })
}

#[cfg(test)]
mod tests {
    use super::limits;

    #[test]
    fn pins_of_limits_with_numbers_values_of_the_ini_file_and_signals() {
        let text = "loadrt trivkins\nsetp ini.x.max_velocity 25 # slower\nsetp ini.0.max_acceleration [JOINT_0]GAIN\n\
            net fast => ini.z.max_velocity\nsetp ini.traj_max_velocity 40\nsetp stepgen.0.maxvel 30\n";
        let found: Vec<String> = limits(text)
            .map(|limit| {
                let value = limit.value(|section, key| (key == "GAIN").then(|| format!("{section}/{key}")));
                format!("{} {} {value:?}", limit.section, limit.key)
            })
            .collect();
        assert_eq!(
            found,
            [
                "AXIS_X MAX_VELOCITY Ok(\"25\")",
                "JOINT_0 MAX_ACCELERATION Ok(\"JOINT_0/GAIN\")",
                "AXIS_Z MAX_VELOCITY Err(\"a signal sets it while the machine runs\")",
                "TRAJ MAX_LINEAR_VELOCITY Ok(\"40\")",
            ]
        );
    }
}
