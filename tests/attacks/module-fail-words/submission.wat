(module
  (import "kinemark" "fail" (func $fail (param i32 i32)))
  (data (i32.const 8) "</script><script>alert(1)</script>")
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (call $fail (i32.const 8) (i32.const 34)))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
