%
O1002 (fixable)
(gcheck: control=haas-mill)
G21 G17 G40 G49 G80 G90 G54
G00 G00 X10. Y10.
M30
%
