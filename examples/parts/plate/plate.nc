%
O2 (PLATE: POCKET WITH A RAMPED ISLAND, T-SLOT, DOVETAIL, DIMPLES, CHAMFER)
G21 G90 G17
(rows that ramp down over what becomes the island)
T1 M6
S5000 M3
G54 G43 H1
G0 X-64 Y-20 Z5
#1=-20.
M98 P100 L11
(pocket: wall and island, 4 mm a level, ramping in along the wall)
#2=0.
M98 P200 L3
G0 Z5
(ball: dimples in the island)
T2 M6
S8000 M3
G54 G43 H2
#1=-46.
M98 P300 L4
(slots, then T-slot and dovetail cutters)
T3 M6
S5000 M3
G54 G43 H3
#1=34. #2=-7.
M98 P400
#2=-13.
M98 P400
#1=61. #2=-5.
M98 P400
#2=-10.
M98 P400
T4 M6
S2500 M3
G54 G43 H4
#1=34. #2=-21.
M98 P400
T5 M6
S2500 M3
G54 G43 H5
#1=61. #2=-10.
M98 P400
(chamfer of the pocket's edge, 1.5 mm)
T6 M6
S6000 M3
G54 G43 H6
G0 X-40 Y0 Z5
G0 X-30 Y32
G1 Z-3.5 F800
G1 X-30 Y34
X-62
G3 X-72 Y24 I0 J-10
G1 Y-24
G3 X-62 Y-34 I10 J0
G1 X2
G3 X12 Y-24 I0 J10
G1 Y24
G3 X2 Y34 I-10 J0
G1 X-30
G1 Y32
G0 Z60
M30
O100 (one ramp)
G0 X-64 Y#1
G0 Z1
G1 Z-1.5 F1500
G1 X4 Z-8.5
G0 Z5
#1=#1+4.
M99
O200 (one level of the pocket: #2 is where the last one ended)
G0 X-66 Y0
G0 Z[#2+1]
G1 Z#2 F1500
Y-24 Z[#2-1]
G3 X-62 Y-28 I4 J0
G1 X2 Z[#2-4]
G3 X6 Y-24 I0 J4
G1 Y24
G3 X2 Y28 I-4 J0
G1 X-62
G3 X-66 Y24 I0 J-4
G1 Y-24
G3 X-62 Y-28 I4 J0
G1 X2
G3 X6 Y-24 I0 J4
G1 Y0
(round the island)
G3 X-16 Y22 I-22 J0
G1 X-44
G3 X-44 Y-22 I0 J-22
G1 X-16
G3 X6 Y0 I0 J22
G1 X6 Y10
G0 Z5
#2=#2-4.
M99
O300 (one dimple)
G0 X#1 Y0 Z5
G1 Z[-7.5-0.103*[#1+30]] F500
G4 P100
G0 Z5
#1=#1+10.66667
M99
O400 (through the plate at x = #1, depth #2)
G0 X#1 Y-80 Z20
G0 Z#2
G1 Y80 F900
G0 Z20
M99
%
