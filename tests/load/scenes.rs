//! Requests of every kind and size, each a few numbers that can be changed a little.

use super::dice::Dice;
use serde_json::{Value, json};

/// What is analysed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    Arch,
    /// Courses of blocks, every second one shifted by half a block.
    Wall,
    /// Blocks in a row on a slab.
    Slab,
    /// Courses with toothed faces: bodies of many corners and joints.
    Layers,
    /// Spans with rings on piers.
    Bridge,
    Beam,
}

/// What is asked of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim {
    Collapse,
    Safety,
    Curve(usize),
    Settlement,
    Motion,
    Accuracy(usize),
    /// With joints that crush on the path, and the strength of the stone, Pa.
    Crushing(f64),
    Steps(f64),
}

/// A request in numbers.
#[derive(Debug, Clone)]
pub struct Scene {
    pub shape: Shape,
    /// Voussoirs, blocks a course or on the slab, teeth, or voussoirs of a ring; courses, layers or spans; rings.
    pub counts: [usize; 3],
    pub mesh: [usize; 2],
    pub aim: Aim,
    /// Thickness that differs from stone to stone.
    pub uneven: bool,
    pub updated: bool,
    pub fields: usize,
    /// One less the share of collapse.
    pub before: f64,
    /// Fill, and a bridge's backing and abutments.
    pub soil: bool,
    /// Bands of lateral pressure.
    pub bands: usize,
}

impl Scene {
    pub fn any(dice: &mut Dice) -> Self {
        let shape = [Shape::Arch, Shape::Wall, Shape::Slab, Shape::Bridge, Shape::Layers, Shape::Beam][dice.below(6)];
        let mut scene = Scene {
            shape,
            counts: [dice.decades(3.0, 2000.0) as usize, dice.decades(2.0, 40.0) as usize, 1 + dice.below(4)],
            mesh: [dice.decades(1.0, 48.9) as usize, dice.decades(1.0, 48.9) as usize],
            aim: Aim::Collapse,
            uneven: dice.chance(0.5),
            updated: dice.chance(0.2),
            fields: 0,
            before: dice.decades(1e-3, 0.999),
            soil: dice.chance(0.3),
            bands: 0,
        };
        scene.aim = scene.any_aim(dice);
        scene
    }

    fn any_aim(&self, dice: &mut Dice) -> Aim {
        match dice.below(11) {
            0 => Aim::Safety,
            1 => Aim::Curve(dice.decades(2.0, 500.0) as usize),
            2 => Aim::Settlement,
            3 => Aim::Motion,
            4 => Aim::Accuracy(dice.decades(100.0, 100_000.0) as usize),
            5 | 6 => Aim::Crushing(dice.decades(2e4, 2e8)),
            7 => Aim::Steps(dice.decades(1e-5, 0.1)),
            _ => Aim::Collapse,
        }
    }

    /// With one or two of its numbers changed.
    pub fn changed(&self, dice: &mut Dice) -> Self {
        let mut scene = self.clone();
        for _ in 0..1 + dice.below(2) {
            let by = dice.decades(0.5, 2.0);
            let scaled = |count: usize, most: usize| ((count as f64 * by).round() as usize).clamp(1, most);
            match dice.below(10) {
                0 | 1 => scene.counts[0] = scaled(scene.counts[0], 2000),
                2 => scene.counts[1] = scaled(scene.counts[1], 60),
                3 => scene.counts[2] = scaled(scene.counts[2], 20),
                4 => scene.mesh[0] = scaled(scene.mesh[0], 48),
                5 => scene.mesh[1] = scaled(scene.mesh[1], 48),
                6 => scene.aim = scene.any_aim(dice),
                7 => (scene.uneven, scene.updated) = (dice.chance(0.5), dice.chance(0.3)),
                8 => (scene.soil, scene.bands) = (dice.chance(0.5), dice.below(3) * dice.decades(1.0, 500.0) as usize),
                _ => (scene.fields, scene.before) = (dice.below(5), dice.decades(1e-3, 0.999)),
            }
        }
        scene
    }

    pub fn request(&self) -> Value {
        if self.shape == Shape::Beam {
            let beam = json!({"inner_radius_m": 0.5, "outer_radius_m": 0.7, "end_shear_n_per_m": 2500.0});
            return match self.aim {
                Aim::Accuracy(_) => json!({"curved_beam": beam, "accuracy": {"stress": 0.001}}),
                _ => json!({"curved_beam": beam, "mesh": self.mesh()}),
            };
        }
        let mut request = json!({"loads": [{"load": {"self_weight": {}}}], "mesh": self.mesh()});
        match self.shape {
            Shape::Arch => request["arch"] = self.arch(),
            Shape::Bridge => request["bridge"] = self.bridge(),
            _ => request["blocks"] = self.blocks(),
        }
        self.ask(&mut request);
        request
    }

    fn mesh(&self) -> Value {
        json!({"subblocks": {"uniform": {"radial": self.mesh[0], "along": self.mesh[1]}}})
    }

    fn ask(&self, request: &mut Value) {
        let push = json!({"load": {"body_acceleration": {"x_g": 0.3}}, "scaled": true});
        let mut fields: Vec<Value> = (1..self.fields).map(|k| json!({"load_factor": 0.01 * k as f64})).collect();
        fields.extend((self.fields > 0).then(|| json!("near_collapse")));
        let report = json!({"stress_fields": fields, "share_of_collapse": 1.0 - self.before});
        if matches!(self.shape, Shape::Arch | Shape::Bridge) {
            self.press(request);
        }
        if self.aim != Aim::Settlement {
            request["loads"].as_array_mut().unwrap().push(push);
            request["report"] = report;
        }
        if self.updated && !matches!(self.aim, Aim::Motion | Aim::Accuracy(_) | Aim::Crushing(_) | Aim::Steps(_)) {
            request["geometry"] = json!("updated");
        }
        match self.aim {
            Aim::Collapse => {}
            Aim::Safety => request["analysis"] = json!({"safety": {}}),
            Aim::Curve(points) => {
                let abscissae: Vec<f64> = (1..=points).map(|i| 0.1 * i as f64).collect();
                request["analysis"] = json!({"safety": {"curve": {"abscissae": abscissae}}});
                let push = request["loads"].as_array_mut().unwrap().last_mut().unwrap();
                push["per_abscissa"] = json!(true);
                request["report"]["stress_fields"] = json!([]);
            }
            Aim::Settlement => {
                let moves = json!({"outwards_m": 0.05});
                let support = |name: &str| json!({"supports": [{"support": name, "downwards_m": 0.05}]});
                request["analysis"] = json!({"settlement": match self.shape {
                    Shape::Arch => json!({"right": moves}),
                    Shape::Bridge => support("ground.right"),
                    _ => support("right"),
                }});
            }
            Aim::Motion => {
                let stones = request["blocks"]["polygons"].as_array().map_or(self.counts.iter().product(), Vec::len);
                let frames = (60_000 / (stones + 10)).clamp(1, 3000);
                request["motion"] = json!({"most_frames": frames, "share_of_span": 1.0});
            }
            Aim::Accuracy(most) => {
                request["accuracy"] = json!({"stress": 0.01, "subblocks": most});
                request["mesh"] = json!({});
                if self.fields == 0 {
                    request["report"]["stress_fields"] = json!(["near_collapse"]);
                }
            }
            Aim::Crushing(strength) => {
                request["crushing_in_path"] = json!(true);
                request["mesh"] = json!({});
                request["stone"] = json!({"compressive_strength_pa": strength});
            }
            Aim::Steps(step) => {
                request["method"] = json!({"fixed_steps": {"step": step, "opening_m": 0.01, "hinges": 4}});
            }
        }
    }

    /// Fill and bands of pressure on an extrados.
    fn press(&self, request: &mut Value) {
        let loads = request["loads"].as_array_mut().unwrap();
        let fill = json!({"load": {"fill_pressure": {"fill_height_m": 13.0, "lateral_ratio": 0.3}}});
        loads.extend(self.soil.then_some(fill));
        let band = |i: usize| json!({"from_m": 0.01 * i as f64, "to_m": 5.0, "pressure_pa": 10.0});
        let bands: Vec<Value> = (0..self.bands).map(band).collect();
        loads.extend((self.bands > 0).then(|| json!({"load": {"lateral_pressure": {"bands": bands}}})));
    }

    fn arch(&self) -> Value {
        let thickness = if self.uneven {
            json!({"linear": {"crown_m": 1.5, "springing_m": 2.0}})
        } else {
            json!({"constant_m": 1.5})
        };
        let circle = json!({"radius_m": 10.0, "opening_angle_deg": 180.0});
        json!({"profile": {"circular": circle}, "thickness": thickness, "voussoirs": self.counts[0].max(2)})
    }

    fn bridge(&self) -> Value {
        let [voussoirs, spans, rings] = self.counts;
        let mut ring = json!({"thickness_m": 0.5, "voussoirs": voussoirs});
        if self.uneven {
            ring["springing_thickness_m"] = json!(0.6);
        }
        let span = json!({"profile": {"circular": {"span_m": 10.0, "rise_m": 3.0}}, "rings": vec![ring; rings]});
        let pier = json!({"top_width_m": 3.0 * rings as f64, "height_m": 5.0, "courses": 2});
        let mut bridge = json!({"spans": vec![span; spans], "piers": vec![pier; spans - 1]});
        if self.soil {
            let abutment = json!({"height_m": 5.0});
            bridge["backing"] = json!({"level_m": 2.0});
            bridge["abutments"] = json!({"left": abutment, "right": abutment});
        }
        bridge
    }

    fn blocks(&self) -> Value {
        let (columns, courses) = (self.counts[0], self.counts[1]);
        if self.shape == Shape::Layers {
            return layers(columns.clamp(2, 100), courses);
        }
        let mut polygons = Vec::new();
        let mut block = |[left, right]: [f64; 2], [low, high]: [f64; 2]| {
            let corners = [[left, low], [right, low], [right, high], [left, high]];
            polygons.push(json!({"name": format!("b{}", polygons.len()), "corners_m": corners}));
        };
        let width = if self.shape == Shape::Slab { columns } else { columns.min(2000 / courses).max(2) };
        // Blocks no two of which are alike, where wanted.
        let uneven = if self.uneven { 0.2 } else { 0.0 };
        let edge = |i: usize, shift: f64| match i {
            0 => 0.0,
            _ => (i as f64 + shift + uneven * (1.7 * i as f64).sin()).min(width as f64),
        };
        if self.shape == Shape::Slab {
            block([0.0, width as f64], [0.0, 1.0]);
            (0..width).for_each(|i| block([i as f64, i as f64 + 1.0], [1.0, 2.0]));
        } else {
            for course in 0..courses {
                let (y, shift) = (0.5 * course as f64, if course % 2 == 1 { -0.5 } else { 0.0 });
                let count = if course % 2 == 1 { width + 1 } else { width };
                for i in 0..count {
                    let right = if i + 1 == count { width as f64 } else { edge(i + 1, shift) };
                    block([edge(i, shift), right], [y, y + 0.5]);
                }
            }
        }
        let middle = 0.5 * width as f64;
        let segment = |from: f64, to: f64| json!([[[from, 0.0], [to, 0.0]]]);
        let mut supports = vec![json!({"name": "left", "segments_m": segment(-1.0, middle)})];
        supports.push(json!({"name": "right", "segments_m": segment(middle, width as f64 + 1.0)}));
        json!({"polygons": polygons, "supports": supports})
    }
}

/// Courses with teeth on both their faces, on level ground.
fn layers(teeth: usize, courses: usize) -> Value {
    let face = |course: usize| -> Vec<[f64; 2]> {
        let height = |x: usize| course as f64 + if course > 0 && x % 2 == 1 { 0.3 } else { 0.0 };
        let at = (0..teeth).filter(|x| course > 0 || x % (teeth - 1) == 0);
        at.map(|x| [x as f64, height(x)]).collect()
    };
    let polygon = |course: usize| {
        let corners: Vec<[f64; 2]> = face(course).into_iter().chain(face(course + 1).into_iter().rev()).collect();
        json!({"name": format!("layer {course}"), "corners_m": corners})
    };
    let middle = 0.5 * (teeth - 1) as f64;
    let segment = |from: f64, to: f64| json!([[[from, 0.0], [to, 0.0]]]);
    json!({
        "polygons": (0..courses).map(polygon).collect::<Vec<_>>(),
        "supports": [{"name": "left", "segments_m": segment(-1.0, middle)},
            {"name": "right", "segments_m": segment(middle, teeth as f64)}],
    })
}
