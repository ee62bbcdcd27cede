; [position-unknown] 2:5: error: G92 says where X is, but X has not been programmed yet (hint: move X with G0 or G1 before)
G92 X0
