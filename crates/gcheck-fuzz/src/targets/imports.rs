//! A description of a machine is read or refused in words, in every format; so is a tool table.
//!
//! Knows: pieces of the formats. Must not know: what they say of a machine.

use gcheck::of_bytes;

use crate::choices::Choices;

const NAMES: &[&str] = &[
    "machine.ini",
    "tool.tbl",
    "tools.csv",
    "settings.txt",
    "library.json",
    "library.fctl",
    "bit.fctb",
    "probe.xml",
    "offsets.nc",
    "unknown",
];

const PIECES: &[&str] = &[
    "\n",
    "[TRAJ]\n",
    "[EMC]\n",
    "[EMCIO]\n",
    "[AXIS_X]\n",
    "[JOINT_0]\n",
    "[KINS]\n",
    "[RS274NGC]\n",
    "[SPINDLE_0]\n",
    "MIN_LIMIT = -10\n",
    "MAX_LIMIT = 10\n",
    "MAX_VELOCITY = 1e9\n",
    "MAX_ACCELERATION = 0\n",
    "LINEAR_UNITS = mm\n",
    "COORDINATES = X Y Z\n",
    "TOOL_TABLE = none.tbl\n",
    "TYPE = ANGULAR\n",
    "#INCLUDE none.inc\n",
    "JOINTS = 3\n",
    "T1 P1 Z0.511 D0.125 ;end mill\n",
    "T99999 Q9 I-1 J+1\n",
    "T1 ",
    "P2 ",
    "Z1e308 ",
    "D-1 ",
    ";x\n",
    "number,length,diameter\n",
    "1,2.5,3\n",
    "\"a\"\"b\",,\n",
    ",",
    "\"",
    "$100=80.000\n",
    "$110=500\n",
    "$130=200.000 (x max)\n",
    "$13=1\n",
    "$120=1e99\n",
    "$$\n",
    "ok\n",
    "{",
    "}",
    "\"data\": [",
    "]",
    "\"unit\": \"millimeters\",",
    "\"geometry\": {\"DC\": 10, \"RE\": 1}",
    "\"post-process\": {\"number\": 1, \"length-offset\": 1}",
    "\"tools\": [{\"nr\": 1, \"path\": \"a.fctb\"}]",
    "\"parameter\": {",
    "\"Diameter\": \"5.00 mm\"",
    "\"version\": 1,",
    ":",
    ",",
    "null",
    "1",
    "\"type\": \"flat end mill\"",
    "<MTConnectDevices>",
    "<Device name=\"a\">",
    "<Axes>",
    "<Linear name=\"X\">",
    "<Rotary name=\"A\">",
    "<DataItem units=\"MILLIMETER\"/>",
    "<Minimum>-1</Minimum>",
    "<Maximum>1</Maximum>",
    "</Linear>",
    "</Axes>",
    "</Device>",
    "</MTConnectDevices>",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?xml version=\"1.0\"?>",
    "&amp;",
    "&#0;",
    "&lt",
    "%\nO1\n",
    "G21\n",
    "G10 L2 P1 X-1. Y2.\n",
    "G10 L10 P1 R10.\n",
    "G10 L20 P1 X1.\n",
    "G10 L1 P1 Z1.\n",
    "M30\n%\n",
    "\r\n",
    "\u{FEFF}",
    "é",
    "=",
    "#",
    " ",
];

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let name = choices.text(NAMES);
    let before = choices.text(&[
        "",
        "[machine]\nunits = \"inch\"\n",
        "machine.travel.X = [0.0, 1.0]\n",
        "tools.1 = { length = 1.0 }\r\n",
    ]);
    let text = if choices.below(3) == 0 {
        String::from_utf8_lossy(choices.rest()).into_owned()
    } else {
        let mut text = String::new();
        for _ in 0..120 {
            if choices.is_empty() {
                break;
            }
            text.push_str(choices.text(PIECES));
        }
        text
    };
    of_bytes::tool_table(&text, name.contains("csv"));
    if let Some(merged) = of_bytes::import(name, text.as_bytes(), before) {
        assert!(of_bytes::configuration(&merged), "an import writes a configuration that is read:\n{merged}");
    }
}
