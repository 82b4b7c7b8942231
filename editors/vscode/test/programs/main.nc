%
O1004 (main)
(gcheck: control=haas-mill)
G21 G17 G40 G49 G80 G90 G54
M98 P2000
M30
%
