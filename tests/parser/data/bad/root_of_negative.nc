; [function-domain] 2:5: error: SQRT of -4 (hint: its argument must not be negative)
G0 XSQRT[-4]
