"""gcheck: reads CNC part programs (G-code) the way the control will. The program is a binary among the scripts."""
