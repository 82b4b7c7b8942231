%
O3000 (sub)
(gcheck: control=haas-mill)
G00 X10. Y10.
M99
%
