"""An orbit's gait for other tools: robot controllers, ROS, MATLAB and Simulink, motion capture, MuJoCo."""
