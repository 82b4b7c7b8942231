//! Kinds of tools by the words of their comments: a boring bar, a drill, a tap, a bar puller, a knife.
//!
//! Knows: the words that shops use. Must not know: any rule, which comments belong to a tool.

use std::rc::Rc;

use gcheck_engine::Fact;

use crate::PathCx;
use crate::facts::tool_comment::{ToolComment, comment_of_tool};

/// Words for a holder that turns its tool, in the languages in which comments were seen.
const POWERED: [&str; 25] = [
    "ACTIONNE",
    "ANGETR",
    "ANGETRIEBEN",
    "ANGETRIEBENE",
    "ANGETRIEBENER",
    "ANGETRIEBENES",
    "DRIVEN",
    "ENTRAINE",
    "LIVE",
    "LIVETOOL",
    "LIVETOOLING",
    "MOTORISE",
    "MOTORISED",
    "MOTORIZADA",
    "MOTORIZADO",
    "MOTORIZED",
    "MOTORIZZATO",
    "POWER",
    "POWERED",
    "ROTARY",
    "ROTATING",
    "SPINNING",
    "TOURNANT",
    "WKZANTRIEB",
    "XPOWER",
];

/// The comment of the tool that works, if it has one.
pub(crate) struct ToolWords(Option<Rc<ToolComment>>);

impl ToolWords {
    /// Of the tool that works.
    pub(crate) fn of(cx: &PathCx<'_>) -> Self {
        let changed = cx.definitions().set_by(Fact::Tool).filter(|at| at.file == 0);
        Self(changed.and_then(|at| comment_of_tool(cx, at)))
    }

    /// Is the tool a bar that bores, and nothing else?
    pub(crate) fn bores(&self) -> bool {
        self.has(&["BORING", "BORE", "BORINGBAR"])
            && !self.has(&["DRILL", "DRILLING", "OD", "TURN", "TURNING", "FACE", "FACING"])
    }

    /// May the tool work in a bore?
    pub(crate) fn may_bore(&self) -> bool {
        self.has(&["BORING", "BORE", "BORINGBAR", "ID", "INSIDE", "INTERNAL", "BAR"])
    }

    /// Is the tool one that makes grooves, or cuts parts off?
    pub(crate) fn grooves(&self) -> bool {
        self.has(&["GROOVE", "GROOVING", "GROOVER", "CUTOFF", "PARTOFF", "PARTING", "BLADE"])
            || self.has(&["CUT", "PART"]) && self.has(&["OFF"])
    }

    /// Is the tool a wide one that mills faces?
    pub(crate) fn faces(&self) -> bool {
        self.has(&["FACE", "FACEMILL", "FACING", "SHELL", "SHELLMILL", "FLYCUTTER"])
    }

    /// Is the tool one that drills?
    pub(crate) fn drills(&self) -> bool {
        self.has(&[
            "DRILL", "DRILLING", "TAP", "TAPPING", "REAM", "REAMER", "REAMING", "SPOT", "CENTER", "CENTRE",
        ])
    }

    /// Is the tool a drill that works on the centre of a turning part, and nowhere else? Drills with inserts bore as well, and spot drills
    /// break edges.
    pub(crate) fn only_drills(&self) -> bool {
        let others = [
            "AFTER",
            "ANGLE",
            "ANGULAR",
            "AXIAL",
            "BAR",
            "BCD",
            "BOLT",
            "BORE",
            "BORING",
            "CBORE",
            "CCGT",
            "CCMT",
            "CENTER",
            "CENTRE",
            "CHAMFER",
            "CLEARANCE",
            "CNMG",
            "CORODRILL",
            "COUNTERBORE",
            "COUNTERSINK",
            "CROSS",
            "CSINK",
            "DCMT",
            "DEBURR",
            "ENLARGE",
            "FACE",
            "FACING",
            "FINISH",
            "GROOVE",
            "GROOVING",
            "HOLE",
            "HOLES",
            "ID",
            "INDEX",
            "INDEXABLE",
            "INSERT",
            "INSERTS",
            "KUB",
            "MILL",
            "MILLING",
            "OD",
            "OPEN",
            "PCD",
            "RADIAL",
            "REAM",
            "REDRILL",
            "RELIEF",
            "ROUGH",
            "RUNOUT",
            "SPADE",
            "SPOT",
            "SPOTDRILL",
            "TAP",
            "THREAD",
            "TURN",
            "TURNING",
            "U",
            "UDRILL",
            "VCMT",
            "WNMG",
        ];
        self.has(&["DRILL"]) && !self.has(&others) && !self.is_powered()
    }

    /// Does the holder turn the tool: a live tool, as shops name it?
    pub(crate) fn is_powered(&self) -> bool {
        let is_centre =
            self.has(&["CENTER", "CENTRE", "CENTERS", "CENTRES"]) && !self.has(&["DRILL", "DRILLING"]);
        self.has(&POWERED) && !is_centre
    }

    /// Does the tool turn while it cuts, as its comment tells: a mill, a drill, a live tool? Such a one broaches nothing.
    pub(crate) fn turns_to_cut(&self) -> bool {
        let mills = ["MILL", "MILLING", "ENDMILL", "FACEMILL", "EM", "BALLMILL", "BULLNOSE"];
        self.has(&mills) || self.drills() || self.is_powered()
    }

    /// Does the tool cut a thread by its own shape, so that it is fed by the pitch: a tap, a die, a chaser?
    pub(crate) fn follows_its_pitch(&self) -> bool {
        self.has(&["TAP", "TAPS", "TAPPING", "TAPPER", "DIE", "DIEHEAD", "DIESTOCK", "CHASER", "CHASERS"])
    }

    /// Does the tool form the surface without a chip, or at the pitch of a pattern: a knurl, a burnisher, a roller?
    pub(crate) fn rolls(&self) -> bool {
        self.has(&[
            "KNURL",
            "KNURLING",
            "KNURLER",
            "BURNISH",
            "BURNISHING",
            "BURNISHER",
            "ROLL",
            "ROLLER",
            "ROLLING",
        ])
    }

    /// May the tool move the bar, or stop it, as far as its comment tells?
    pub(crate) fn may_move_bar(&self) -> bool {
        self.0.is_none() || self.needs_no_spindle()
    }

    /// Does the tool push, hold or touch the work, or cut it while the spindle is stopped: a bar puller, a bar stop, a live centre, a
    /// probe, a drag knife, a broach?
    pub(crate) fn needs_no_spindle(&self) -> bool {
        let holds = [
            "PULLER",
            "PULL",
            "BARPULLER",
            "GRIPPER",
            "GRIP",
            "FEEDER",
            "BARFEED",
            "BARSTOP",
            "STOPPER",
            "PROBE",
            "PROBING",
            "DRAG",
            "DRAGKNIFE",
            "KNIFE",
            "BROACH",
            "BROACHING",
            "KEYWAY",
            "KEYSEAT",
            "SLOTTING",
            "SLOTTER",
            "SHAPER",
            "SHAPING",
            "PUNCH",
            "SERRATION",
            "SPLINE",
            "MARKING",
            "BRUSH",
            "SCRIBE",
            "SCRIBER",
            "SCRATCH",
            "TAILSTOCK",
        ];
        let is_centre = self.has(&["CENTER", "CENTRE", "CENTERS", "CENTRES"])
            && self.has(&["LIVE", "REVOLVING", "ROTATING", "DEAD", "TAIL", "SUPPORT"])
            && !self.has(&["DRILL", "DRILLING", "SPOT"]);
        let is_bar_stop = self.has(&["STOP"]) && !self.has(&["OPTIONAL", "OPT", "PROGRAM", "SPINDLE"]);
        let is_bar_feed = self.has(&["FEED"]) && self.has(&["BAR", "STOCK"]);
        let is_off = self.has(&["SPINDLE"]) && self.has(&["OFF", "NO", "STOPPED"]);
        self.has(&holds) || is_centre || is_bar_stop || is_bar_feed || is_off
    }

    fn has(&self, wanted: &[&str]) -> bool {
        self.0.as_ref().is_some_and(|comment| comment.has(wanted))
    }
}
