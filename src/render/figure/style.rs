//! How things look: legible in black and white, and to the colour-blind (the colours are those of Okabe and Ito).

pub const STYLE: &str = "\
.stone{fill:#f3eddf;stroke:#8b8172;stroke-width:.8;stroke-linejoin:round}
.fine{fill:#f3eddf;stroke:#8b8172;stroke-width:.1}
.abutment{fill:#dcd6ca;stroke:#8b8172;stroke-width:.8;stroke-linejoin:round}
.fill{fill:#ebe7e0;stroke:none}
.layer{fill:#c9c5bf;stroke:#a39e95;stroke-width:.6}
.backing{fill:#d9d2c3;stroke:#a39e95;stroke-width:.6}
.embankment{fill:#dfe3da;stroke:#a39e95;stroke-width:.6}
.road{fill:none;stroke:#3c3a37;stroke-width:2.2;stroke-linejoin:round}
.ground{stroke:#55524d;stroke-width:2}
.hatch{stroke:#55524d;stroke-width:1}
.axis{stroke:#55524d;stroke-width:1.4;stroke-dasharray:9 3 2 3}
.altered{fill:none;stroke:#cc79a7;stroke-width:3.4}
.ghost{fill:#0072b2;fill-opacity:.1;stroke:#0072b2;stroke-opacity:.85;stroke-width:1.2;stroke-linejoin:round}
.thrust{fill:none;stroke:#b3341f;stroke-width:2.2;stroke-linejoin:round;stroke-linecap:round}
.least{fill:none;stroke:#0072b2;stroke-width:2.2;stroke-linejoin:round;stroke-dasharray:8 4}
.resultant{fill:#b3341f}
.near{fill:#fff;stroke:#1d1d1f;stroke-width:1.6}
.hinge{fill:#fff;stroke:#1d1d1f;stroke-width:2.4}
.minor{fill:#fff;stroke:#1d1d1f;stroke-width:1}
.slipping{fill:none;stroke:#a65f00;stroke-width:3}
.slide{stroke:#a65f00;stroke-width:2.4;stroke-linecap:round}
.parting{stroke:#1d1d1f;stroke-width:2.4;stroke-dasharray:3 4}
.crushed{stroke:#b3341f;stroke-width:14;stroke-linecap:round;stroke-opacity:.45}
.load{stroke:#1d1d1f;stroke-width:2.2;stroke-linecap:round}
.idle{stroke:#8a8780;stroke-width:1.6;stroke-linecap:round;stroke-dasharray:4 3}
.soil{stroke:#00795a;stroke-width:1.8;stroke-linecap:round}
.measure{stroke:#55524d;stroke-width:1}
.leader{stroke:#8a8780;stroke-width:.9}
.bar{stroke:#1d1d1f;stroke-width:1.6}
";
