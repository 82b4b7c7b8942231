"""gcheck: checks CNC part programs (G-code) before they run on the machine. The program is a binary among the scripts."""
