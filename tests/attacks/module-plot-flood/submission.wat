(module
  (import "kinemark" "plot" (func $plot (param i32 i32 f64)))
  (data (i32.const 8) "signal")
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (loop $again (call $plot (i32.const 8) (i32.const 6) (f64.const 1)) (br $again)))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
