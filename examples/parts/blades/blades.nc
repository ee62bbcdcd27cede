%
O4 (BLADED HUB: SEVEN CHANNELS CUT IN FIVE AXES BY A TAPER BALL, 7 ROWS EACH)
(hub: r = 16 + 30 [1 - cos s], z = 40 - 36 sin s for s = 0 to 90 deg; the tool stands on its normal)
G21 G90 G17
G53 G0 Z500.
G53 G0 B0. C0.
(bore)
T2 M6
S1500 M3
G54 G43.5 H2
G0 X0 Y0 Z80. I0 J0 K1
G1 Z-6. I0 J0 K1 F300
G0 Z80. I0 J0 K1
G49
G53 G0 Z500.
(channels)
T1 M6
S12000 M3
G54 G43.5 H1
G0 X0 Y0 Z90. I0 J0 K1
#1=0.
M98 P100 L7
G49
G53 G0 Z500.
M30
O100 (one channel about #1 deg)
#2=-1.
M98 P200 L7
#1=#1+51.4285714285714
M99
O200 (one row at the share #2 of the channel's half width)
#3=0.
M98 P900
G0 X[16*COS[#8]] Y[16*SIN[#8]] Z80. I[COS[#8]] J[SIN[#8]] K0
G0 X[16*COS[#8]] Y[16*SIN[#8]] Z50. I[COS[#8]] J[SIN[#8]] K0
M98 P300 L19
G1 X[60*COS[#8]] Y[60*SIN[#8]] Z4. I0 J0 K1
G0 Z90. I0 J0 K1
#2=#2+1/3
M99
O300 (one point of a row)
M98 P900
G1 X[#4*COS[#8]] Y[#4*SIN[#8]] Z#5 I[#6*COS[#8]] J[#6*SIN[#8]] K#7 F2000
#3=#3+5.
M99
O900 (hub at s = #3: radius #4, height #5, normal #6 #7, angle about the axis #8)
#4=16+30*[1-COS[#3]]
#5=40-36*SIN[#3]
#9=SQRT[1296*COS[#3]*COS[#3]+900*SIN[#3]*SIN[#3]]
#6=36*COS[#3]/#9
#7=30*SIN[#3]/#9
(the lean of the channel against a meridian makes it wider around the axis, most at the blades' tips)
#10=1.6*#4*[0.418879020478639*SIN[#3]+0.222222222222222]/#9
#8=#1-24*[1-COS[#3]]-0.222222222222222*#3+#2*[25.7142857142857-275*SQRT[1+#10*#10]/#4]
M99
%
