//! Sensors of descriptions as outputs: against closed forms of a body at rest and of one that turns, and against values of MuJoCo.

use lissom::exchange::import::{Motors, Options, Pose, from_description, model_text};
use lissom_motion::{Rotation, Vector3};

use crate::support::runs::{column, last, run};

fn model(text: &str, values: &[(&str, f64)], rates: &[(&str, f64)]) -> String {
    let robot = from_description(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let by_name =
        |all: &[(&str, f64)]| all.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let pose = Pose { values: by_name(values), rates: by_name(rates), ..Pose::default() };
    model_text(&robot, &pose, Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// A site at r with the rotation S in a body that turns by ω about z: Sᵀ ω, Sᵀ (ω × r), Sᵀ (ω × (ω × r) - g).
#[test]
fn inertial_sensors_have_their_own_axes() {
    let [wx, wy, wz] = [0.3, -0.5, 0.7];
    let own = Rotation::about_axis(&Vector3::z(), wz)
        * Rotation::about_axis(&Vector3::y(), wy)
        * Rotation::about_axis(&Vector3::x(), wx);
    let mjcf = "<mujoco><compiler angle='radian' eulerseq='XYZ'/><option gravity='1 0 -9.81'/><worldbody><body name='b' pos='0 0 1'>
        <joint name='j' axis='0 0 1'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>
        <site name='s' pos='0.4 0.1 0.2' euler='0.3 -0.5 0.7'/></body><site name='w' pos='0 0 3'/></worldbody>
        <sensor><gyro name='g' site='s'/><velocimeter name='v' site='s'/><accelerometer name='a' site='s'/><accelerometer name='still' site='w'/>
        <jointpos name='angle' joint='j'/><jointvel joint='j'/><touch site='s'/><framepos objtype='geom' objname='x'/>
        <gyro site='s' cutoff='1'/></sensor></mujoco>";
    let sdf = "<sdf version='1.9'><world name='w'><gravity>1 0 -9.81</gravity><model name='m'><link name='b'><inertial><mass>1</mass></inertial>
        <sensor name='s' type='imu'><pose>0.4 0.1 0.2 0.3 -0.5 0.7</pose></sensor></link><joint name='j' type='continuous'><parent>world</parent>
        <child>b</child><axis/></joint></model></world></sdf>";
    for rate in [0.0, 2.0] {
        let (turning, at) = (Vector3::new(0.0, 0.0, rate), Vector3::new(0.4, 0.1, 0.2));
        let gravity = Vector3::new(1.0, 0.0, -9.81);
        let sensed = |global: Vector3| own.inverse().apply(&global);
        let wanted = [
            sensed(turning),
            sensed(turning.cross(&at)),
            sensed(turning.cross(&turning.cross(&at)) - gravity),
        ];
        for (text, names) in [(mjcf, ["g", "v", "a"]), (sdf, ["b_s_gyro", "", "b_s_acceleration"])] {
            let record = run(&model(text, &[], &[("j", rate)]), &[("analysis.end", "1e-3")]);
            for (name, wanted) in names.iter().zip(&wanted).filter(|(name, _)| !name.is_empty()) {
                let found = [1, 2, 3].map(|k| column(&record, &format!("{name}_{k}"), "value")[0]);
                assert!((Vector3::from(found) - wanted).norm() < 1e-9, "{name}: {found:?} {wanted:?}");
            }
        }
    }
    let text = model(mjcf, &[("j", 0.5)], &[("j", 2.0)]);
    let record = run(&text, &[("analysis.end", "1e-3")]);
    assert_eq!([1, 2, 3].map(|k| column(&record, &format!("still_{k}"), "value")[0]), [-1.0, 0.0, 9.81]);
    assert!((column(&record, "angle", "value")[0] - 0.5).abs() < 1e-12);
    assert!((column(&record, "jointvel6", "value")[0] - 2.0).abs() < 1e-9);
    assert!(
        text.contains(
            "# Omitted: sensors that are not converted to outputs: 1 <framepos>, 1 <gyro>, 1 <touch>."
        ),
        "{text}"
    );
}

/// An arm with a tilted hinge, a fixed body, a slide and a second hinge; values of MuJoCo 4.0 after 0.2 s in steps of 10 µs.
#[test]
fn sensors_of_a_moving_arm_agree_with_mujoco() {
    let text = "<mujoco><compiler angle='radian'/><option gravity='0.3 -0.4 -9.81'/><worldbody>
        <body name='arm' pos='0.1 0.2 1' euler='0.3 0.2 0.1'><joint name='hip' axis='0 1 0.2' pos='0.1 0 0' damping='0.1' ref='0.2'/>
         <inertial pos='0.2 0.05 0' mass='1.3' diaginertia='0.02 0.03 0.04'/><site name='plain' pos='0.1 0.1 0.1'/>
         <body name='fixed' pos='0 0.1 0' euler='0.5 0 0'><inertial pos='0.1 0 0' mass='0.2' diaginertia='0.002 0.003 0.004'/>
          <site name='tilted' pos='0.05 0 0.2' euler='0.7 -0.3 0.4'/></body>
         <body name='fore' pos='0.4 0 0'><joint name='slide' type='slide' axis='1 0 0' stiffness='40'/><joint name='elbow' axis='1 0 0'/>
          <inertial pos='0.1 0 0.1' mass='0.5' diaginertia='0.01 0.012 0.014'/><site name='s2' pos='0.05 0.1 0.2' quat='0.5 0.5 0.5 0.5'/>
         </body></body></worldbody>
        <sensor><jointpos name='a' joint='hip'/><jointvel name='b' joint='hip'/><jointpos name='c' joint='slide'/><jointvel name='d' joint='slide'/>
         <framepos name='p' objtype='body' objname='fore'/><framepos name='p2' objtype='xbody' objname='fixed'/>
         <framelinvel name='v' objtype='site' objname='tilted'/><framelinvel name='v2' objtype='body' objname='fore'/>
         <frameangvel name='w' objtype='body' objname='fore'/><accelerometer name='acc' site='tilted'/><accelerometer name='acc2' site='plain'/>
         <gyro name='g' site='plain'/><gyro name='g2' site='s2'/><velocimeter name='vm' site='tilted'/><velocimeter name='vm2' site='s2'/></sensor></mujoco>";
    let text = model(text, &[("hip", 0.6), ("elbow", 0.4)], &[]);
    let set = [("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3"), ("analysis.end", "0.2")];
    let record = run(&text, &set);
    for (name, wanted) in
        [("a", 0.850_805_427_5), ("b", 2.112_764_489), ("c", 0.071_290_398_24), ("d", 0.719_139_288_2)]
    {
        let found = last(&record, name, "value");
        assert!((found - wanted).abs() < 1e-7, "{name}: {found} {wanted}");
    }
    for (name, letters, wanted) in [
        ("p", ["x", "y", "z"], [0.569_992_199_3, 0.337_816_713, 0.704_090_591_2]),
        ("p2", ["x", "y", "z"], [0.112_384_840_9, 0.265_475_337_2, 1.085_272_641]),
        ("v", ["v1", "v2", "v3"], [0.314_265_228_9, 0.117_578_749_6, -0.171_922_424_1]),
        ("v2", ["v1", "v2", "v3"], [-0.294_370_595_4, 0.442_788_327_9, -1.408_537_962]),
        ("w", ["w1", "w2", "w3"], [2.068_476_953, 3.214_641_674, -1.151_153_857]),
        ("g", ["w1", "w2", "w3"], [0.0, 2.071_736_031, 0.414_347_206_1]),
        ("acc", ["", "", ""], [-2.628_498_536, 8.555_380_267, -0.067_879_877_43]),
        ("acc2", ["", "", ""], [-6.060_759_189, 4.086_344_123, 5.966_283_812]),
        ("g2", ["", "", ""], [1.803_421_942, -1.100_655_752, 3.387_314_484]),
        ("vm", ["", "", ""], [0.368_607_296, -0.059_173_703_89, -0.052_648_365_86]),
        ("vm2", ["", "", ""], [-1.141_158_597, -0.421_032_899_8, 1.189_889_252]),
    ] {
        for (k, letter) in letters.iter().enumerate() {
            let found = match *letter {
                "" => last(&record, &format!("{name}_{}", k + 1), "value"),
                letter => last(&record, name, letter),
            };
            assert!((found - wanted[k]).abs() < 2e-7, "{name}[{k}]: {found} {}", wanted[k]);
        }
    }
}

/// A servo for the rate of a slide: m v' = k (u - v).
#[test]
fn servos_of_slides_have_rates() {
    let text = "<mujoco><option gravity='0 0 0'/><worldbody><body name='b'><joint name='s' type='slide'/><geom size='0.1' mass='2'/></body>
        </worldbody><actuator><velocity joint='s' kv='3'/></actuator></mujoco>";
    let robot = from_description(text).expect("a robot");
    let options = Options { motors: Motors::Written, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).expect("a model");
    let record = run(&text, &[("inputs.s_motor", "0.4"), ("analysis.end", "0.3")]);
    let found = last(&record, "s", "velocity");
    assert!((found - 0.4 * (1.0 - (-1.5 * 0.3_f64).exp())).abs() < 1e-6, "{found}");
}
