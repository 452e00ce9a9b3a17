//! X1 and X2: the worked tables of the RFID paper, which must come out exactly.
